/* One face against a packet of rays from an apex: is it nearer than the nearest so far, and does it block a shadow ray?
 * nearest.cl and shadow.cl choose the faces. All values are computed in `real`, and have error bounds:
 *
 *     beyond the bounds: the answer is certain
 *     within them: the lane is uncertain, and intersect_exactly.cl decides
 *
 * So the picture does not depend on the bounds. They only decide how often exact arithmetic is needed. docs/kernels.md,
 * section 5. */
#include "shared/compiler.cl"
#include "shared/layout.h"
#include "shared/precision.cl"
#include "packet/apex.cl"
#include "packet/faces.cl"
#include "packet/intersect_exactly.cl"
#include "packet/lanes.cl"
#include "packet/planes.cl"
#include "packet/rays.cl"
#include "packet/vectors.cl"
#include "packet/world.cl"

/* The nearest faces so far. t is measured from the apex. */
typedef struct Nearest {
    Lanes low, high;    /* 1/t is between these; 0: no face yet */
    Lanes begin, limit; /* the t at which the ray begins; 1/begin */
    Mask face;          /* its place on the device; -1: none */
    Mask from_behind;   /* N.R > 0: the ray came from behind the normal */
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
        hit.from_behind = here ? nearest->from_behind : hit.from_behind;
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
    nearest->from_behind = take ? hit.from_behind : nearest->from_behind;
    return true;
}

/* The lanes in which rounding might make the back of a closed box as near as its front. There the ray passes an edge of
 * face i closely, or meets its plane close to the nearest face. */
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
    nearest->from_behind = take ? (Mask)(f->from_behind ? -1 : 0) : nearest->from_behind;
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
