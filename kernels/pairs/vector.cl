/* Vectors of pairs of floats, and rays of them. */
#include "shared/compiler.cl"
#include "shared/exact.cl"
#include "shared/layout.h"
#include "plain/scene.cl"
#include "pairs/pair.cl"

/* Three pairs: x, y, z. shared/exact.cl takes it for a vector without error. */
typedef Exact PairVec;

INLINE PairVec pairs_of(Pair x, Pair y, Pair z)
{
    PairVec v = {x, y, z};
    return v;
}

/* The sum of two vectors of floats, of which `low` is what rounding took from `high`. */
INLINE PairVec pairs_from(float3 high, float3 low)
{
    return pairs_of(two_sum(high.x, low.x), two_sum(high.y, low.y), two_sum(high.z, low.z));
}

/* Three numbers of two floats each. */
INLINE PairVec pairs_at(global const float *a)
{
    return pairs_of(two_sum(a[0], a[1]), two_sum(a[2], a[3]), two_sum(a[4], a[5]));
}

/* Three values of the view. */
INLINE PairVec view_pairs(const Scene *scene, int column)
{
    global const real *row = scene->view + column;
    return pairs_from(vload3(0, row), vload3(0, row + VIEW_REALS));
}

INLINE PairVec pairs_sum(PairVec a, PairVec b)
{
    return pairs_of(pair_sum(a.x, b.x), pair_sum(a.y, b.y), pair_sum(a.z, b.z));
}

INLINE PairVec pairs_minus(PairVec a) { return pairs_of(pair_minus(a.x), pair_minus(a.y), pair_minus(a.z)); }
INLINE PairVec pairs_difference(PairVec a, PairVec b) { return pairs_sum(a, pairs_minus(b)); }

INLINE PairVec pairs_times(Pair s, PairVec a)
{
    return pairs_of(pair_product(s, a.x), pair_product(s, a.y), pair_product(s, a.z));
}

INLINE Pair pairs_dot(PairVec a, PairVec b)
{
    return pair_sum(pair_sum(pair_product(a.x, b.x), pair_product(a.y, b.y)), pair_product(a.z, b.z));
}

INLINE float3 rounded(PairVec a) { return (float3)(a.x.high, a.y.high, a.z.high); }
INLINE float3 low_parts(PairVec a) { return (float3)(a.x.low, a.y.low, a.z.low); }

INLINE float largest_of(const PairVec *a) { return fmax(fmax(fabs(a->x.high), fabs(a->y.high)), fabs(a->z.high)); }

/* a 2^n, without rounding. */
INLINE PairVec pairs_ldexp(PairVec a, int n)
{
    return pairs_of(pair_ldexp(a.x, n), pair_ldexp(a.y, n), pair_ldexp(a.z, n));
}

/* The n for which the largest component of a 2^n is from 1 to 2. */
INLINE int to_near_one(const PairVec *a)
{
    float largest = largest_of(a);
    return largest > 0 && isfinite(largest) ? -ilogb(largest) : 0;
}

/* P(t) = origin + t direction. The direction's largest component is about 1, so that products of it stay in range. */
typedef struct PairRay {
    PairVec origin, direction;
    int from; /* the face that it leaves, -1: none */
} PairRay;

/* The ray along a direction of any length, which is multiplied by 2^to_near_one. */
INLINE PairRay pair_ray(PairVec origin, PairVec direction, int from)
{
    PairRay ray = {origin, pairs_ldexp(direction, to_near_one(&direction)), from};
    return ray;
}
