/* Exact signs for points that are pairs of floats: on which side of an edge a ray passes, and on which side of a plane
 * a point lies. As in shared/exact.cl, a value is first computed with an error bound, here in pairs; within the bound,
 * it is added up without rounding.
 *
 * The difference of a vertex, which is floats, and of a point, which is pairs, is three floats long in each component.
 * It is kept as two vectors of pairs, and a determinant is the sum of the determinants of these parts.
 * docs/bounds.md, "Pairs of floats". */
#include "shared/compiler.cl"
#include "shared/exact.cl"
#include "shared/layout.h"
#include "plain/scene.cl"
#include "pairs/pair.cl"
#include "pairs/vector.cl"

#define PAIR_ROUNDING 0x1p-44f /* 16 u^2: what is added up here are some operations of at most 5 u^2 each */

/* A vector without error: high + low. `low` is mostly zero. */
typedef struct Difference {
    PairVec high, low;
} Difference;

/* a - b without error. */
INLINE void split_difference(Pair a, Pair b, Pair *high, Pair *low)
{
    Pair s = two_sum(a.high, -b.high), rest = two_sum(a.low, -b.low), middle = two_sum(s.low, rest.high);
    *high = two_sum(s.high, middle.high);
    *low = two_sum(middle.low, rest.low);
}

INLINE Difference exactly_between(PairVec a, PairVec b)
{
    Difference d;
    split_difference(a.x, b.x, &d.high.x, &d.low.x);
    split_difference(a.y, b.y, &d.high.y, &d.low.y);
    split_difference(a.z, b.z, &d.high.z, &d.low.z);
    return d;
}

INLINE Difference without_rest(PairVec a)
{
    Difference d = {a, pairs_of(pair_of(0), pair_of(0), pair_of(0))};
    return d;
}

/* The same in pairs. */
INLINE PairVec pairs_of_difference(Difference d) { return pairs_sum(d.high, d.low); }

INLINE float magnitudes_of(PairVec a) { return fabs(a.x.high) + fabs(a.y.high) + fabs(a.z.high); }

/* Multiplies the vector by 2^n, which makes its largest component 2^40 to 2^41. Returns n. The product of three such
 * components is a float, and so is its last bit, 269 bits below. */
static int move_into_range(Difference *a)
{
    int n = 40 + to_near_one(&a->high);
    a->high = pairs_ldexp(a->high, n);
    a->low = pairs_ldexp(a->low, n);
    return n;
}

/* Of the three vectors one is 2 floats long in each component, and two are 3, or one is 4 and two are 2. */
enum { PAIR_TERMS = 6 * 2 * 3 * 3 * 4 };

INLINE bool is_zero(const PairVec *a) { return a->x.high == 0 && a->y.high == 0 && a->z.high == 0; }

/* Adds det(r, a, b) to an expansion. Returns its number of terms then. */
NOINLINE int add_determinant(float *terms, int count, const PairVec *r, const PairVec *a, const PairVec *b)
{
    if (is_zero(r) || is_zero(a) || is_zero(b))
        return count;
    count = expansion_add_product(terms, count, 1, r->x, a->y, b->z);
    count = expansion_add_product(terms, count, -1, r->x, a->z, b->y);
    count = expansion_add_product(terms, count, 1, r->y, a->z, b->x);
    count = expansion_add_product(terms, count, -1, r->y, a->x, b->z);
    count = expansion_add_product(terms, count, 1, r->z, a->x, b->y);
    return expansion_add_product(terms, count, -1, r->z, a->y, b->x);
}

/* det(r, a, b), added up without rounding. *exponent: the value is times 2^exponent. A part of a vector is a vector. */
NOINLINE Pair exact_pair_determinant(Difference r, Difference a, Difference b, int *exponent)
{
    float terms[PAIR_TERMS];
    int count = 0;
    *exponent = move_into_range(&r) + move_into_range(&a) + move_into_range(&b);
    if (!isfinite(magnitudes_of(r.high) + magnitudes_of(a.high) + magnitudes_of(b.high)))
        return pair_of(0); /* a number beyond those of floats: the expansion would grow without end */
    for (int i = 0; i < 8; i++)
        count = add_determinant(terms, count, i & 1 ? &r.low : &r.high, i & 2 ? &a.low : &a.high,
                                i & 4 ? &b.low : &b.high);
    Pair value = pair_of(0);
    for (int i = 0; i < count; i++)
        value = pair_sum(value, pair_of(terms[i]));
    return value;
}

INLINE int sign_of(float x) { return (x > 0) - (x < 0); }

/* The sign of det(r, a, b): -1, 0 or 1. */
static int pair_determinant_sign(const PairVec *r, const Difference *a, const Difference *b)
{
    PairVec p = pairs_of_difference(*a), q = pairs_of_difference(*b);
    Pair yz = pair_product(p.y, q.z), zy = pair_product(p.z, q.y);
    Pair zx = pair_product(p.z, q.x), xz = pair_product(p.x, q.z);
    Pair xy = pair_product(p.x, q.y), yx = pair_product(p.y, q.x);
    PairVec cross = pairs_of(pair_difference(yz, zy), pair_difference(zx, xz), pair_difference(xy, yx));
    float value = pairs_dot(*r, cross).high;
    float magnitude = fabs(r->x.high) * (fabs(yz.high) + fabs(zy.high)) +
                      fabs(r->y.high) * (fabs(zx.high) + fabs(xz.high)) +
                      fabs(r->z.high) * (fabs(xy.high) + fabs(yx.high));
    bool sure = magnitude > 0x1p-60f && fabs(value) > 2 * PAIR_ROUNDING * magnitude;
    int exponent;
    return sign_of(sure ? value : exact_pair_determinant(without_rest(*r), *a, *b, &exponent).high);
}

INLINE PairVec vertex_of(const Scene *scene, int face, int k)
{
    float3 v = face_vertex(scene, face, k);
    return pairs_of(pair_of(v.x), pair_of(v.y), pair_of(v.z));
}

/* The edge from a to b as a ray along r sees it: the sign of det(r, a - o, b - o). */
static int edge_sign_of_ray(const PairVec *o, const PairVec *r, PairVec a, PairVec b)
{
    Difference to_a = exactly_between(a, *o), to_b = exactly_between(b, *o);
    return pair_determinant_sign(r, &to_a, &to_b);
}

/* The same for the segment from o to `end`: det(end - o, a - o, b - o) = det(b - a, o - a, end - a), and b - a is pairs
 * without error. */
static int edge_sign_of_segment(const PairVec *o, const PairVec *end, PairVec a, PairVec b)
{
    Difference edge = exactly_between(b, a), from = exactly_between(*o, a), to = exactly_between(*end, a);
    edge.high = pairs_ldexp(edge.high, to_near_one(&edge.high));
    return pair_determinant_sign(&edge.high, &from, &to);
}

/* Step 4: does the line through o pass inside all edges? It is that of a ray along `towards`, or of the segment to that
 * point. 1: it does, along the normal, -1: against it, 0: it does not. */
static int pairs_inside(const Scene *scene, int face, const PairVec *o, const PairVec *towards, bool is_segment)
{
    int lowest = 1, highest = -1;
    for (int k = 0; k < 4; k++) {
        PairVec a = vertex_of(scene, face, k), b = vertex_of(scene, face, (k + 1) & 3);
        if (a.x.high == b.x.high && a.y.high == b.y.high && a.z.high == b.z.high)
            continue; /* a triangle has three edges */
        int sign = is_segment ? edge_sign_of_segment(o, towards, a, b) : edge_sign_of_ray(o, towards, a, b);
        lowest = min(lowest, sign);
        highest = max(highest, sign);
    }
    return lowest >= 0 && highest > 0 ? 1 : highest <= 0 && lowest < 0 ? -1 : 0;
}

INLINE PairVec plane_normal(const Scene *scene, int face)
{
    global const wide *row = plane_row(scene, face);
    return pairs_from(vload3(0, row + PLANE_NORMAL), vload3(0, row + PLANE_NORMAL_LOW));
}

/* How far N.x in pairs may be from the exact one. */
INLINE float pairs_dot_error(const Scene *scene, int face, const PairVec *x)
{
    return (plane_row(scene, face)[PLANE_ERROR] + PAIR_ROUNDING) * magnitudes_of(*x);
}

/* M.x without rounding, where M is the cross product of the face's diagonals: N, but for its length. */
static Pair exact_cross_dot(const Scene *scene, int face, Difference x, int *exponent)
{
    Difference a = exactly_between(vertex_of(scene, face, 2), vertex_of(scene, face, 0));
    Difference b = exactly_between(vertex_of(scene, face, 3), vertex_of(scene, face, 1));
    return exact_pair_determinant(x, a, b, exponent);
}

/* The sign of N.x. */
static int normal_sign(const Scene *scene, int face, Difference x)
{
    PairVec rounded_x = pairs_of_difference(x);
    float value = pairs_dot(plane_normal(scene, face), rounded_x).high;
    bool sure = fabs(value) > pairs_dot_error(scene, face, &rounded_x) + 0x1p-80f;
    int exponent;
    return sign_of(sure ? value : exact_cross_dot(scene, face, x, &exponent).high);
}

/* The side of the face's plane that the point lies on: +1 where N points, 0 in the plane, -1 behind. */
static int plane_side(const Scene *scene, int face, const PairVec *point)
{
    return normal_sign(scene, face, exactly_between(*point, vertex_of(scene, face, 0)));
}
