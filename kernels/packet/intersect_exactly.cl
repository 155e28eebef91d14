/* One face against a packet of any rays, exactly: is it nearer than the nearest so far, and does it block a shadow ray?
 *
 *     do the edges let the ray pass inside?
 *     nearest:    is t > 0, and smaller than that of the nearest face so far?
 *     shadow ray: are its two ends on different sides of the plane?
 *
 * The signs are exact, and t is clamped to where the ray is in the face's box. docs/algorithm.md, sections 3 to 6. */
#include "shared/compiler.cl"
#include "shared/layout.h"
#include "shared/precision.cl"
#include "packet/box.cl"
#include "packet/edges.cl"
#include "packet/faces.cl"
#include "packet/lanes.cl"
#include "packet/planes.cl"
#include "packet/rays.cl"
#include "packet/vectors.cl"
#include "packet/world.cl"

/* The nearest faces so far. */
typedef struct Hit {
    Wide t;
    Wide t_in_box;    /* the t nearest to that one at which the ray is in the face's box: it decides what is nearest */
    Mask face;        /* its place on the device; -1: none */
    Mask index;       /* its place in the scene, which decides between equal t */
    Mask from_behind; /* N.R > 0: the ray came from behind the normal */
} Hit;

INLINE Hit no_hit(void)
{
    Hit hit = {(Wide)WIDE_MAX, (Wide)WIDE_MAX, (Mask)-1, (Mask)-1, (Mask)0};
    return hit;
}

/* Where the active rays meet the plane of face i. meets_box: the lanes whose ray meets the face's box. t_in_box: as
 * Hit. */
INLINE PlaneHit hit_in_box(const World *world, int i, const Ray *ray, WideMask active, Wide *t_in_box,
                           WideMask *meets_box)
{
    PlaneHit hit = plane_hit(world, i, &ray->origin, &ray->direction, active);
    *t_in_box = hit.t;
    *meets_box = (WideMask)-1;
    if (!face_is_flat(world, i)) {
        Interval in_box = interval_in_box(world->faces + i, ray);
        *meets_box = IS(in_box.enter <= in_box.leave);
        *t_in_box = *t_in_box < in_box.enter ? in_box.enter : *t_in_box;
        *t_in_box = *t_in_box > in_box.leave ? in_box.leave : *t_in_box;
    }
    return hit;
}

/* Takes face i in those active lanes where it is nearer, exactly. True if there are any. */
NOINLINE bool intersect_nearest(const World *world, const RealRay *real_ray, const Ray *ray, Mask active, int i,
                                Hit *nearest)
{
    EdgeTest edges = test_edges(real_ray, face_row(world, i));
    edges.may &= active;
    if (!ANY(edges.may))
        return false;
    if (ANY(edges.may & ~edges.sure))
        resolve_edges_exactly(&edges, face_row(world, i), ray, 0);
    if (face_bits(face_row(world, i)) & FACE_ONE_SIDED) {
        edges.may &= ~edges.from_behind;
        if (!ANY(edges.may))
            return false;
    }

    Wide t_in_box;
    WideMask ahead;
    PlaneHit hit = hit_in_box(world, i, ray, TO_WIDE_MASK(edges.may), &t_in_box, &ahead);
    /* The signs of the edges are that of N.R, too. The ray starts on the other side. */
    ahead &= TO_WIDE_MASK(edges.from_behind) ? IS(hit.distance < (Wide)0) : IS(hit.distance > (Wide)0);
    Mask index = (Mask)world->faces[i].index;
    WideMask first = IS(t_in_box == nearest->t_in_box) & TO_WIDE_MASK(IS(index < nearest->index));
    WideMask nearer = TO_WIDE_MASK(edges.may) & ahead & IS(hit.t <= (Wide)WIDE_MAX) &
                      (IS(t_in_box < nearest->t_in_box) | first);
    Mask take = TO_MASK(nearer);
    nearest->t = nearer ? hit.t : nearest->t;
    nearest->t_in_box = nearer ? t_in_box : nearest->t_in_box;
    nearest->face = take ? (Mask)i : nearest->face;
    nearest->index = take ? index : nearest->index;
    nearest->from_behind = take ? edges.from_behind : nearest->from_behind;
    return ANY(take);
}

/* The active lanes whose segment from `point` to `target` face i blocks, exactly. The edges are tested along the
 * reversed ray, from the light, so that all lanes share an origin. */
NOINLINE Mask intersect_segment(const World *world, const WideVec *point, const wide *target, Mask active, int i)
{
    WideVec end = wide_of(target);
    Ray ray = {*point, wide_sub(end, *point)};
    RealRay l = real_ray(vec_to_real(end), vec_to_real(wide_sub(*point, end)));
    EdgeTest edges = test_edges(&l, face_row(world, i));
    edges.may &= active;
    if (ANY(edges.may & ~edges.sure))
        resolve_edges_exactly(&edges, face_row(world, i), &ray, target);
    PlaneRow plane = plane_row(world, i);
    wide end_side = plane_distance_of_point(world, i, target);
    Wide start = plane_distance(world, i, &plane, *point, TO_WIDE_MASK(edges.may));
    WideMask before = IS(start > (Wide)0), behind = IS(start < (Wide)0);
    bool one_sided = face_bits(face_row(world, i)) & FACE_ONE_SIDED;
    WideMask between = end_side < 0 ? before : end_side > 0 && !one_sided ? behind : (WideMask)0;
    if (!face_is_flat(world, i)) {
        Interval in_box = interval_in_box(world->faces + i, &ray);
        between &= IS(in_box.enter <= in_box.leave) & IS(in_box.enter <= (Wide)1);
    }
    return edges.may & TO_MASK(between);
}
