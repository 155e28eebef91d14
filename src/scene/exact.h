/* Arithmetic without rounding: sums and products of two doubles as pairs of doubles, and a 3x3 determinant by
 * floating-point expansions. An expansion is an unevaluated sum of doubles; sums and products of expansions are exact
 * (Shewchuk, "Adaptive Precision Floating-Point Arithmetic and Fast Robust Geometric Predicates", 1997, sections
 * 2.3-2.7). Expansions are slow, and wanted only where a rounded value is too close to zero to trust. */
#ifndef RECTRAY_EXACT_H
#define RECTRAY_EXACT_H

#include "base/vec3.h"

/* A number known to twice the precision of a double: high + low, high being the rounded value. */
typedef struct Pair {
    double high, low;
} Pair;

/* a + b without error: Knuth's TwoSum (Shewchuk 1997, theorem 7). */
static inline Pair exact_sum(double a, double b)
{
    double sum = a + b;
    double b_seen = sum - a;
    double a_seen = sum - b_seen;
    return (Pair){sum, (a - a_seen) + (b - b_seen)};
}

/* Dekker's split into two halves of 26 bits (Shewchuk 1997, theorem 17). */
static inline Pair exact_split(double a)
{
    double c = 134217729.0 * a; /* 2^27 + 1 */
    double high = c - (c - a);
    return (Pair){high, a - high};
}

/* a * b without error: Dekker's product (Shewchuk 1997, theorem 18). fma would do it in one step but is slow where the
 * processor lacks it. */
static inline Pair exact_product(double a, double b)
{
    double product = a * b;
    Pair x = exact_split(a), y = exact_split(b);
    double error = ((x.high * y.high - product) + x.high * y.low + x.low * y.high) + x.low * y.low;
    return (Pair){product, error};
}

/* The same of a vector, component by component. */
typedef struct ExactVec3 {
    Vec3 high, low;
} ExactVec3;

/* a - b without error. */
static inline ExactVec3 exact_difference(Vec3 a, Vec3 b)
{
    Pair x = exact_sum(a.x, -b.x), y = exact_sum(a.y, -b.y), z = exact_sum(a.z, -b.z);
    return (ExactVec3){vec3(x.high, y.high, z.high), vec3(x.low, y.low, z.low)};
}

static inline ExactVec3 exact_vec3(Vec3 a)
{
    return (ExactVec3){a, vec3(0, 0, 0)};
}

/* det(a, b, c) = a . (b x c) to within an ulp or two, its sign exact. This holds unless a product of three components
 * leaves the range 2^-960 .. 2^1000, which the scene's limits on coordinates exclude. */
double exact_determinant(ExactVec3 a, ExactVec3 b, ExactVec3 c);

#endif
