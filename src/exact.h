/* Signs without rounding: the exact sign of a 3x3 determinant, by floating-point expansions.
 * An expansion is an unevaluated sum of doubles; sums and products of expansions are exact (Shewchuk,
 * "Adaptive Precision Floating-Point Arithmetic and Fast Robust Geometric Predicates", 1997, sections 2.3-2.7).
 * Slow, and called only where a rounded value is too close to zero to trust. Floor 1. */
#ifndef RECTRAY_EXACT_H
#define RECTRAY_EXACT_H

#include "vec3.h"

/* A vector known to twice the precision of a double: high + low, exactly. */
typedef struct ExactVec3 {
    Vec3 high, low;
} ExactVec3;

/* a - b without error (Knuth's TwoSum in each component). */
ExactVec3 exact_difference(Vec3 a, Vec3 b);

ExactVec3 exact_vec3(Vec3 a);

/* The sign (-1, 0, +1) of det(a, b, c) = a . (b x c). Exact unless a product of three components leaves the range
 * 2^-960 .. 2^1000, which the scene's limits on coordinates exclude. */
int exact_determinant_sign(ExactVec3 a, ExactVec3 b, ExactVec3 c);

#endif
