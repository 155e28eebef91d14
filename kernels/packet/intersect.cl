/* The two questions that a ray asks a scene: which face is nearest, and is anything between here and the light.
 * Here is what one face answers; in which order faces are asked is the business of walk.cl. Each question has two forms: one
 * for any rays, exact, and a fast one for rays from an apex, which leaves to the first what it is not sure of. */
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

/* The nearest face so far, lane by lane. */
typedef struct Hit {
    Wide t;
    Wide t_in_box;    /* t, or the nearest t at which the ray is in the face's box; it decides what is nearest */
    Mask face;        /* its place in the device's order, -1: none */
    Mask index;       /* its place in the scene's order, which decides between equal t */
    Mask with_normal; /* N.R > 0: the ray came from behind the normal */
} Hit;

INLINE Hit no_hit(void)
{
    Hit hit = {(Wide)WIDE_MAX, (Wide)WIDE_MAX, (Mask)-1, (Mask)-1, (Mask)0};
    return hit;
}

/* t of each active ray in the face's plane, and the t nearest to it at which the ray is in the face's box. */
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

/* Asks face i in the active lanes; true if it is nearer in some lane. */
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
    /* The edges have told the sign of N.R. */
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

/* Asks face i; the active lanes whose segment, from `point` to `target`, it blocks. The line is told the other way round: it
 * starts at the target. */
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

/* The nearest face so far, lane by lane. Depths are values of t, from the apex. */
typedef struct Nearest {
    Lanes low, high;    /* 1/t is between these; 0: no face yet */
    Lanes begin, limit; /* the ray begins at this depth; 1/begin */
    Mask face;          /* its place in the device's order, -1: none */
    Mask with_normal;   /* N.R > 0: the ray came from behind the normal */
} Nearest;

INLINE Nearest nothing_yet(void)
{
    Nearest n = {(Lanes)0, (Lanes)0, (Lanes)0, (Lanes)INFINITY, (Mask)-1, (Mask)0};
    return n;
}

/* What is known of the nearest faces, exactly, in the active lanes; -1 elsewhere. */
static Hit exact_hit(const World *world, const Ray *ray, const Nearest *nearest, Mask active)
{
    Hit hit = no_hit();
    for (Mask rest = active & IS(nearest->face >= (Mask)0); ANY(rest);) {
        int face = first_of(nearest->face, rest);
        Mask here = rest & IS(nearest->face == (Mask)face);
        rest &= ~here;
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

/* Asks face i exactly in the lanes in uncertain; true if it is nearer in some. */
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

/* Of the lanes, those in which the ray passes so near to an edge of face i, or meets its plane so near to the nearest face, that
 * rounding might put the point on the other side. */
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

/* Asks face i; true if it is nearer in some lane. Comparisons are such that NaN, from overflow, is a uncertain. near_ties: collects the
 * lanes in which rounding decides, or might make the back of a closed box as near as its front. */
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

/* Asks face i, seen from the light; the active lanes whose points it blocks. uncertain: those that only intersect_segment can tell. */
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
