/* Three doubles: a point, a direction or an RGB colour.
 * Everything above is written in these few operations, so that a formula in the code reads like the
 * formula in the book. */
#ifndef RECTRAY_VEC3_H
#define RECTRAY_VEC3_H

#include <math.h>

typedef struct Vec3 {
    double x, y, z;
} Vec3;

/* An operation, a line. */
/* clang-format off */

static inline Vec3 vec3(double x, double y, double z) { return (Vec3){x, y, z}; }
static inline Vec3 vec3_add(Vec3 a, Vec3 b) { return vec3(a.x + b.x, a.y + b.y, a.z + b.z); }
static inline Vec3 vec3_sub(Vec3 a, Vec3 b) { return vec3(a.x - b.x, a.y - b.y, a.z - b.z); }
static inline Vec3 vec3_scale(double s, Vec3 a) { return vec3(s * a.x, s * a.y, s * a.z); }
static inline Vec3 vec3_negate(Vec3 a) { return vec3(-a.x, -a.y, -a.z); }

/* Component by component: how a surface colour filters the colour of a light. */
static inline Vec3 vec3_multiply(Vec3 a, Vec3 b) { return vec3(a.x * b.x, a.y * b.y, a.z * b.z); }

static inline double vec3_dot(Vec3 a, Vec3 b) { return a.x * b.x + a.y * b.y + a.z * b.z; }

static inline Vec3 vec3_cross(Vec3 a, Vec3 b)
{
    return vec3(a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x);
}

/* x, y, z by number. */
static inline double vec3_component(Vec3 a, int axis) { return axis == 0 ? a.x : axis == 1 ? a.y : a.z; }

static inline double vec3_length(Vec3 a) { return sqrt(vec3_dot(a, a)); }

/* a / |a|; the caller makes sure that a is not zero. */
static inline Vec3 vec3_unit(Vec3 a)
{
    double length = vec3_length(a);
    return vec3(a.x / length, a.y / length, a.z / length);
}

/* |x| + |y| + |z|: no smaller than the length, and at most sqrt(3) times as large. */
static inline double vec3_magnitudes(Vec3 a) { return fabs(a.x) + fabs(a.y) + fabs(a.z); }

/* The largest of |x|, |y|, |z|. */
static inline double vec3_largest(Vec3 a) { return fmax(fabs(a.x), fmax(fabs(a.y), fabs(a.z))); }

/* The exponent e of a power of two with 2^(e-1) <= vec3_largest(a) < 2^e; 0 for zero. */
static inline int vec3_exponent(Vec3 a)
{
    int exponent;
    frexp(vec3_largest(a), &exponent);
    return exponent;
}

/* 2^exponent a, exact but where it leaves the range of doubles. */
static inline Vec3 vec3_ldexp(Vec3 a, int exponent)
{
    return vec3(ldexp(a.x, exponent), ldexp(a.y, exponent), ldexp(a.z, exponent));
}

static inline int vec3_is_finite(Vec3 a) { return isfinite(a.x) && isfinite(a.y) && isfinite(a.z); }

/* clang-format on */

#endif
