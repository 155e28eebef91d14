/* One face against a packet of rays: is it nearer than the nearest so far, and does it block a shadow ray? nearest.cl
 * and shadow.cl choose the faces. Each question has a fast form, for rays from an apex, and an exact form, for any
 * rays. The fast form computes in `real`, with error bounds:
 *
 *     beyond the bounds: the answer is certain
 *     within them: the lane is uncertain, and asks the exact form
 *
 * So the picture does not depend on the bounds. They only say how often the exact form is asked. */
#include "shared/compiler.cl"
#include "shared/layout.h"
#include "shared/precision.cl"
#include "packet/apex.cl"
#include "packet/box.cl"
#include "packet/edges.cl"
#include "packet/faces.cl"
#include "packet/lanes.cl"
#include "packet/planes.cl"
#include "packet/rays.cl"
#include "packet/vectors.cl"
#include "packet/world.cl"

/* --- Any rays, exactly --- */

/* The nearest faces so far. */
typedef struct Hit {
    Wide t;
    Wide t_in_box;    /* the t nearest to that one at which the ray is in the face's box: it decides what is nearest */
    Mask face;        /* its place on the device; -1: none */
    Mask index;       /* its place in the scene, which decides between equal t */
    Mask with_normal; /* N.R > 0: the ray came from behind the normal */
} Hit;

INLINE Hit no_hit(void)
{
    Hit hit = {(Wide)WIDE_MAX, (Wide)WIDE_MAX, (Mask)-1, (Mask)-1, (Mask)0};
    return hit;
}

/* Where the active rays meet the plane of face i. ahead: the lanes whose ray meets the face's box. t_in_box: as Hit. */
INLINE PlaneHit hit_in_box(const World *world, int i, const Ray *ray, WideMask active, Wide *t_in_box,
                           WideMask *ahead)
{
    PlaneHit hit = plane_hit(world, i, &ray->origin, &ray->direction, active);
    *t_in_box = hit.t;
    *ahead = (WideMask)-1;
    if (!face_is_flat(world, i)) {
        Interval in_box = interval_in_box(world->faces + i, ray);
        *ahead = IS(in_box.enter <= in_box.leave);
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
    if (face_bits(face_row(world, i)) & FACE_BACK_OPEN) {
        edges.may &= ~edges.with_normal;
        if (!ANY(edges.may))
            return false;
    }

    Wide t_in_box;
    WideMask ahead;
    PlaneHit hit = hit_in_box(world, i, ray, TO_WIDE_MASK(edges.may), &t_in_box, &ahead);
    /* The signs of the edges are that of N.R, too. The ray starts on the other side. */
    ahead &= TO_WIDE_MASK(edges.with_normal) ? IS(hit.distance < (Wide)0) : IS(hit.distance > (Wide)0);
    Mask index = (Mask)world->faces[i].index;
    WideMask first = IS(t_in_box == nearest->t_in_box) & TO_WIDE_MASK(IS(index < nearest->index));
    WideMask nearer = TO_WIDE_MASK(edges.may) & ahead & IS(hit.t <= (Wide)WIDE_MAX) &
                      (IS(t_in_box < nearest->t_in_box) | first);
    Mask take = TO_MASK(nearer);
    nearest->t = nearer ? hit.t : nearest->t;
    nearest->t_in_box = nearer ? t_in_box : nearest->t_in_box;
    nearest->face = take ? (Mask)i : nearest->face;
    nearest->index = take ? index : nearest->index;
    nearest->with_normal = take ? edges.with_normal : nearest->with_normal;
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
    bool open = face_bits(face_row(world, i)) & FACE_BACK_OPEN;
    WideMask between = end_side < 0 ? before : end_side > 0 && !open ? behind : (WideMask)0;
    if (!face_is_flat(world, i)) {
        Interval in_box = interval_in_box(world->faces + i, &ray);
        between &= IS(in_box.enter <= in_box.leave) & IS(in_box.enter <= (Wide)1);
    }
    return edges.may & TO_MASK(between);
}

/* --- Rays from an apex, fast --- */

/* The nearest faces so far. t is measured from the apex. */
typedef struct Nearest {
    Lanes low, high;    /* 1/t is between these; 0: no face yet */
    Lanes begin, limit; /* the t at which the ray begins; 1/begin */
    Mask face;          /* its place on the device; -1: none */
    Mask with_normal;   /* N.R > 0: the ray came from behind the normal */
} Nearest;

INLINE Nearest nothing_yet(void)
{
    Nearest n = {(Lanes)0, (Lanes)0, (Lanes)0, (Lanes)INFINITY, (Mask)-1, (Mask)0};
    return n;
}

/* The same faces as exact hits, in the active lanes. Elsewhere there is none. */
static Hit exact_hit(const World *world, const Ray *ray, const Nearest *nearest, Mask active)
{
    Hit hit = no_hit();
    for (Mask rest = active & IS(nearest->face >= (Mask)0); ANY(rest);) {
        int face;
        Mask here = take_same(nearest->face, &rest, &face);
        WideMask wide_here = TO_WIDE_MASK(here), ahead;
        Wide t_in_box;
        PlaneHit at = hit_in_box(world, face, ray, wide_here, &t_in_box, &ahead);
        hit.t = wide_here ? at.t : hit.t;
        hit.t_in_box = wide_here ? t_in_box : hit.t_in_box;
        hit.face = here ? (Mask)face : hit.face;
        hit.index = here ? (Mask)world->faces[face].index : hit.index;
        hit.with_normal = here ? nearest->with_normal : hit.with_normal;
    }
    return hit;
}

/* Takes face i in those uncertain lanes where it is nearer, exactly. True if there are any. */
NOINLINE bool resolve_nearest_exactly(const World *world, const Ray *ray, Mask uncertain, int i, Nearest *nearest)
{
    RealRay l = real_ray(vec_to_real(ray->origin), vec_to_real(ray->direction));
    Hit hit = exact_hit(world, ray, nearest, uncertain);
    if (!intersect_nearest(world, &l, ray, uncertain, i, &hit))
        return false;
    Mask take = uncertain & IS(hit.face == (Mask)i);
    Lanes inverse = 1 / (TO_REAL(hit.t_in_box) + nearest->begin);
    nearest->low = take ? inverse * (1 - 64 * REAL_ROUNDING) : nearest->low;
    nearest->high = take ? inverse * (1 + 64 * REAL_ROUNDING) : nearest->high;
    nearest->face = take ? (Mask)i : nearest->face;
    nearest->with_normal = take ? hit.with_normal : nearest->with_normal;
    return true;
}

/* The lanes in which rounding might make the back of a closed box as near as its front: the ray passes an edge of face
 * i closely, or meets its plane close to the nearest face. */
NOINLINE Mask near_tie(const World *world, const Ray *ray, Mask lanes, int i, const Nearest *nearest)
{
#if REAL_DOUBLE || HAS_DOUBLE
    const wide share = 0x1p-26f; /* rounding in `wide` is far below it */
    global const real *row = face_row(world, i);
    Wide largest = fabs(ray->direction.x);
    largest = GREATER(largest, fabs(ray->direction.y));
    largest = GREATER(largest, fabs(ray->direction.z));
    Wide size = wide_magnitudes(from_vertex(row, ray->origin)) + wide_magnitudes(ray->origin);
    Wide bound = share * (wide)edge_bound(face_bits(row)) * largest * size;
    WideMask near = (WideMask)0;
    for (int k = 0; k < 4; k++) {
        global const real *v = row + k, *w = row + (k + 1) % 4;
        WideVec a = wide_vec((wide)v[0] - ray->origin.x, (wide)v[4] - ray->origin.y, (wide)v[8] - ray->origin.z);
        WideVec b = wide_vec((wide)w[0] - ray->origin.x, (wide)w[4] - ray->origin.y, (wide)w[8] - ray->origin.z);
        WideVec c = wide_vec(a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x);
        near |= ~IS(fabs(wide_dot(ray->direction, c)) > bound);
    }
    Wide t = plane_hit(world, i, &ray->origin, &ray->direction, TO_WIDE_MASK(lanes)).t;
    Wide best = exact_hit(world, ray, nearest, lanes).t;
    near |= ~IS(fabs(t - best) > share * fabs(t));
    return lanes & TO_MASK(near);
#else
    return lanes;
#endif
}

/* Takes face i where it is nearer. True if there are such lanes. near_ties: collects the lanes of near_tie.
 * The comparisons are such that NaN, which overflow makes, is uncertain. */
INLINE bool intersect_nearest_from(const World *world, const OriginPacket *p, const Ray *ray, const FaceSetup *f,
                                   int i, Nearest *nearest, Mask *near_ties)
{
    Lanes edge = least_edge(p->ahead, f);
    Mask may = p->active & ~IS(edge < (Lanes)-f->edge_error) & IS(p->from != (Mask)i);
    if (!ANY(may))
        return false;
    Lanes inverse = along(p->ahead, f->nx, f->ny, f->nz);
    Lanes low = inverse - f->depth_error, high = inverse + f->depth_error;
    may &= ~IS(high < nearest->low) & ~IS(low > nearest->limit) & IS(nearest->face != (Mask)i);
    Mask grazing = f->closed ? may & ~IS(edge > (Lanes)(4 * f->edge_error)) : (Mask)0;
    Mask take = may & IS(edge > (Lanes)f->edge_error) & IS(low > nearest->high) & IS(high < nearest->limit);
    Mask uncertain = may & ~take;
    if (ANY(uncertain | grazing))
        *near_ties |= near_tie(world, ray, uncertain | grazing, i, nearest);
    nearest->low = take ? low : nearest->low;
    nearest->high = take ? high : nearest->high;
    nearest->face = take ? (Mask)i : nearest->face;
    nearest->with_normal = take ? (Mask)(f->with_normal ? -1 : 0) : nearest->with_normal;
    bool nearer = ANY(take);
    if (nearer) {
        fetch(world->faces + i, sizeof(FaceRecord));
        fetch(world->planes + (size_t)i * PLANE_REALS, PLANE_REALS * sizeof(wide));
    }
    if (ANY(uncertain))
        nearer |= resolve_nearest_exactly(world, ray, uncertain, i, nearest);
    return nearer;
}

/* The active lanes whose shadow rays face i blocks. uncertain: the lanes that intersect_segment has to decide. */
INLINE Mask intersect_segment_from(const OriginPacket *p, const FaceSetup *f, int i, Mask *uncertain)
{
    Lanes edge = least_edge(p->ahead, f), edge_error = p->slack * f->edge_error;
    Mask may = p->active & ~IS(edge < -edge_error) & IS(p->from != (Mask)i);
    *uncertain = (Mask)0;
    if (!ANY(may))
        return (Mask)0;
    Lanes inverse = along(p->ahead, f->nx, f->ny, f->nz), depth_error = p->slack * f->depth_error;
    may &= ~IS(inverse + depth_error < p->per_end);
    Mask blocked = may & IS(edge > edge_error) & IS(inverse - depth_error > p->per_end);
    *uncertain = may & ~blocked;
    return blocked;
}
