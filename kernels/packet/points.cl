/* Exact hit points, in `wide`, and the points next to them at which shadow rays and reflected rays start. A point is
 * computed when it is first needed. For most hits the approximate point of approx.cl is enough. Computing points only
 * for those faces of a packet where a ray is uncertain took 7 % from the time of menger-4. docs/algorithm.md, section
 * 6. */
#include "shared/compiler.cl"
#include "shared/layout.h"
#include "shared/precision.cl"
#include "packet/faces.cl"
#include "packet/intersect.cl"
#include "packet/lanes.cl"
#include "packet/planes.cl"
#include "packet/rays.cl"
#include "packet/vectors.cl"
#include "packet/world.cl"

/* Moves a point along n, the normal on the rays' side, to where it is surely on that side of the face's plane, and
 * hardly farther: as point_shifted in src/scene/geometry.c. */
static WideVec point_shifted(const World *world, int face, const PlaneRow *plane, WideVec n, WideMask from_behind,
                             WideVec point)
{
    global const real *row = face_row(world, face);
    Wide height, slack;
    if (ROUNDED_IS_POOR) {
        WidePairs x = from_vertex_exactly(row, point);
        height = normal_dot_accurate(plane, row, &x, (WideMask)-1).high;
        slack = ACCURATE_ERROR(*plane) * wide_magnitudes(x.high);
    } else {
        WideVec x = from_vertex(row, point);
        height = normal_dot(plane, x);
        slack = ROUNDED_ERROR(*plane) * wide_magnitudes(x);
    }
    height = from_behind ? -height : height;
    Wide margin = 2 * WIDE_ROUNDING * wide_magnitudes(point) + 12 * WIDE_ROUNDING * fabs(height) + slack;
    margin = margin > (Wide)SHIFT_FLOOR ? margin : (Wide)SHIFT_FLOOR;
    return wide_add(point, wide_scale(margin - height, n));
}

/* Where the rays of the lanes `here` meet the face. */
INLINE WideVec point_on(const World *world, const Ray *ray, bool from_eye, int face, Mask here)
{
    WideMask wide_here = TO_WIDE_MASK(here);
    Wide t = from_eye ? plane_hit_from_point(world, face, &ray->origin, &ray->direction, wide_here).t
                      : plane_hit(world, face, &ray->origin, &ray->direction, wide_here).t;
    return wide_add(ray->origin, wide_scale(t, ray->direction));
}

/* The points of a tile. */
typedef struct LazyPoints {
    const World *world;
    const Ray *rays; /* of each packet, as the next two */
    const Nearest *nearest;
    const Mask *active;
    bool from_eye;       /* the rays have one origin */
    Mask ready[PACKETS]; /* the lanes whose points have been computed */
    WideVec point[PACKETS], shifted[PACKETS];
} LazyPoints;

INLINE void begin_points(const World *world, LazyPoints *points, const Ray *rays, const Nearest *nearest,
                         const Mask *active, bool from_eye)
{
    points->world = world;
    points->rays = rays;
    points->nearest = nearest;
    points->active = active;
    points->from_eye = from_eye;
    EACH_PACKET(p)
        points->ready[p] = (Mask)0;
}

/* Computes the points of those lanes of packet p that are not ready, and of all active lanes that meet the same
 * faces. */
NOINLINE void need_points(LazyPoints *points, int p, Mask lanes)
{
    const World *world = points->world;
    const Nearest *nearest = points->nearest + p;
    WideMask from_behind = TO_WIDE_MASK(nearest->from_behind);
    for (Mask rest = lanes & points->active[p] & ~points->ready[p]; ANY(rest);) {
        int face = first_of(nearest->face, rest);
        Mask here = points->active[p] & IS(nearest->face == (Mask)face);
        bool first = !ANY(points->ready[p]);
        rest &= ~here;
        points->ready[p] |= here;
        WideVec point = point_on(world, points->rays + p, points->from_eye, face, here);
        PlaneRow plane = plane_row(world, face);
        WideVec normal = wide_vec((Wide)plane.x, (Wide)plane.y, (Wide)plane.z);
        WideVec turned = wide_select(from_behind, wide_vec(-normal.x, -normal.y, -normal.z), normal);
        WideVec off = point_shifted(world, face, &plane, turned, from_behind, point);
        if (first) { /* mostly there is one face: nothing to blend */
            points->point[p] = point;
            points->shifted[p] = off;
            continue;
        }
        WideMask wide_here = TO_WIDE_MASK(here);
        points->point[p] = wide_select(wide_here, point, points->point[p]);
        points->shifted[p] = wide_select(wide_here, off, points->shifted[p]);
    }
}

/* The shifted points of packet p, ready in those lanes. */
INLINE const WideVec *shifted_point(LazyPoints *points, int p, Mask lanes)
{
    need_points(points, p, lanes);
    return points->shifted + p;
}

/* N of each active lane's face, on the side that the ray came from. */
static WideVec wide_normal(const World *world, const Nearest *nearest, Mask active)
{
    WideVec normal = wide_vec((Wide)0, (Wide)0, (Wide)0);
    for (Mask rest = active; ANY(rest);) {
        int face;
        Mask here = take_same(nearest->face, &rest, &face);
        global const wide *row = world->planes + (size_t)face * PLANE_REALS;
        normal = wide_select(TO_WIDE_MASK(here), wide_vec((Wide)row[0], (Wide)row[1], (Wide)row[2]), normal);
    }
    return wide_select(TO_WIDE_MASK(nearest->from_behind), wide_vec(-normal.x, -normal.y, -normal.z), normal);
}

/* Replaces the rays of packet p's active lanes by those that their faces reflect, and their apex by its image. In
 * double, directions are made unit vectors, as the reference does. In float they keep their length, as the camera's
 * image does. */
INLINE void reflect(LazyPoints *points, int p, Mask active, Ray *ray, WideVec *apex)
{
    need_points(points, p, active);
    WideVec r = ROUNDED_IS_POOR ? wide_unit(ray->direction) : ray->direction;
    WideVec n = wide_normal(points->world, points->nearest + p, active);
    ray->direction = wide_sub(r, wide_scale(2 * wide_dot(r, n), n));
    ray->origin = points->shifted[p];
    *apex = wide_sub(*apex, wide_scale(2 * wide_dot(wide_sub(*apex, points->point[p]), n), n));
}
