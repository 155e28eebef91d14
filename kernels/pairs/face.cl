/* A face against a ray of pairs: plain/exact_arithmetic.cl for devices without double. It promises the same: rounding
 * decides nothing, for the ray as it is stored.
 * docs/algorithm.md, sections 3 to 6, has the formulas. */
#include "shared/compiler.cl"
#include "shared/layout.h"
#include "plain/scene.cl"
#include "pairs/pair.cl"
#include "pairs/signs.cl"
#include "pairs/vector.cl"

/* A value in pairs with fewer than 24 bits that are sure is computed without rounding. */
#define POOR_VALUE 0x1p24f

typedef struct PairHit {
    int face; /* its place on the device, -1: none */
    Pair t;
    Pair t_in_box;    /* t, kept within the face's box: it decides what is nearest */
    bool from_behind; /* N.R > 0 */
    PairVec point;    /* P */
    PairVec normal;   /* N turned to the side that the ray came from */
    PairVec shifted;  /* P moved off the face along N */
} PairHit;

/* From t = enter to t = leave; none where enter > leave. */
typedef struct PairInterval {
    Pair enter, leave;
} PairInterval;

/* Narrows the interval to between two planes across an axis, and reaches beyond it by more than rounding took away. */
static void cross_planes(PairInterval *in, float low, float high, Pair origin, Pair direction)
{
    if (direction.high == 0) {
        if (pair_less(origin, pair_of(low)) || pair_less(pair_of(high), origin))
            in->enter = pair_of(INFINITY);
        return;
    }
    Pair to_low = pair_quotient(pair_difference(pair_of(low), origin), direction);
    Pair to_high = pair_quotient(pair_difference(pair_of(high), origin), direction);
    bool forward = direction.high > 0;
    Pair enter = forward ? to_low : to_high, leave = forward ? to_high : to_low;
    enter = pair_difference(enter, pair_of(fabs(enter.high) * 0x1p-40f));
    leave = pair_sum(leave, pair_of(fabs(leave.high) * 0x1p-40f));
    in->enter = pair_less(in->enter, enter) ? enter : in->enter;
    in->leave = pair_less(leave, in->leave) ? leave : in->leave;
}

/* The part of a ray in the box of a face. One across an axis has every hit in its box. */
static PairInterval pairs_in_box(const Scene *scene, int face, const PairRay *ray)
{
    PairInterval in = {pair_of(0), pair_of(INFINITY)};
    if (scene->faces[face].material & FACE_FLAT)
        return in;
    global const float *box = scene->faces[face].box;
    cross_planes(&in, box[0], box[1], ray->origin.x, ray->direction.x);
    cross_planes(&in, box[2], box[3], ray->origin.y, ray->direction.y);
    cross_planes(&in, box[4], box[5], ray->origin.z, ray->direction.z);
    return in;
}

/* t = N.(v0 - O) / N.R. */
static Pair pair_t(const Scene *scene, int face, const PairRay *ray)
{
    PairVec n = plane_normal(scene, face);
    Difference from = exactly_between(vertex_of(scene, face, 0), ray->origin);
    PairVec to_face = pairs_of_difference(from);
    Pair distance = pairs_dot(n, to_face), approach = pairs_dot(n, ray->direction);
    if (fabs(distance.high) > POOR_VALUE * pairs_dot_error(scene, face, &to_face) &&
        fabs(approach.high) > POOR_VALUE * pairs_dot_error(scene, face, &ray->direction))
        return pair_quotient(distance, approach);
    int e, f;
    distance = exact_cross_dot(scene, face, from, &e);
    approach = exact_cross_dot(scene, face, without_rest(ray->direction), &f);
    return pair_ldexp(pair_quotient(distance, approach), f - e);
}

/* Steps 3 and 4: does the ray hit the face? */
static bool face_test(const Scene *scene, int face, const PairRay *ray, PairHit *hit)
{
    int towards = normal_sign(scene, face, without_rest(ray->direction));
    if (towards * plane_side(scene, face, &ray->origin) >= 0) /* parallel, or behind the origin */
        return false;
    hit->from_behind = towards > 0;
    if ((hit->from_behind && is_one_sided(scene, face)) ||
        pairs_inside(scene, face, &ray->origin, &ray->direction, false) == 0)
        return false;
    PairInterval in_box = pairs_in_box(scene, face, ray);
    hit->face = face;
    hit->t = pair_t(scene, face, ray);
    hit->t_in_box = pair_less(hit->t, in_box.enter) ? in_box.enter : hit->t;
    hit->t_in_box = pair_less(in_box.leave, hit->t_in_box) ? in_box.leave : hit->t_in_box;
    return isfinite(hit->t.high) && !pair_less(in_box.leave, in_box.enter);
}

/* Step 6: is the face strictly between the ray's origin and `end`, where t = end_t? Then its plane parts them. */
static bool face_blocks(const Scene *scene, int face, const PairRay *ray, const PairVec *end, float end_t)
{
    int start = plane_side(scene, face, &ray->origin);
    if (start * plane_side(scene, face, end) >= 0 || (start < 0 && is_one_sided(scene, face)) ||
        pairs_inside(scene, face, &ray->origin, end, true) == 0)
        return false;
    PairInterval in_box = pairs_in_box(scene, face, ray);
    return !pair_less(in_box.leave, in_box.enter) && in_box.enter.high <= end_t;
}

/* Step 6: P moved along the normal to where it is surely on that side of the plane. */
static PairVec point_shifted(const Scene *scene, const PairHit *hit)
{
    Difference from = exactly_between(hit->point, vertex_of(scene, hit->face, 0));
    PairVec from_vertex = pairs_of_difference(from);
    float bound = pairs_dot_error(scene, hit->face, &from_vertex);
    Pair height = pairs_dot(hit->normal, from_vertex);
    float margin = 2 * PAIR_ROUNDING * (magnitudes_of(hit->point) + fabs(height.high)) + bound;
    return pairs_sum(hit->point, pairs_times(pair_difference(pair_of(fmax(margin, SHIFT_FLOOR)), height), hit->normal));
}

/* The point of the hit, the normal on the ray's side, and the point from which the next rays start. */
static void place_hit(const Scene *scene, const PairRay *ray, PairHit *hit)
{
    PairVec n = plane_normal(scene, hit->face);
    hit->point = pairs_sum(ray->origin, pairs_times(hit->t, ray->direction));
    hit->normal = hit->from_behind ? pairs_minus(n) : n;
    hit->shifted = point_shifted(scene, hit);
}
