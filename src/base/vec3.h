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

static inline double vec3_length(Vec3 a) { return sqrt(vec3_dot(a, a)); }

/* a / |a|; the caller makes sure that a is not zero. */
static inline Vec3 vec3_unit(Vec3 a)
{
    double length = vec3_length(a);
    return vec3(a.x / length, a.y / length, a.z / length);
}

static inline int vec3_is_finite(Vec3 a) { return isfinite(a.x) && isfinite(a.y) && isfinite(a.z); }

/* clang-format on */

#endif
