/* What textbook.c computes with: `Real` is float where textbook_float.c includes it, else double. The names of its
 * functions differ by precision, its vectors and the structs of its steps by `Real`. */
#ifndef RECTRAY_TEXTBOOK_REAL_H
#define RECTRAY_TEXTBOOK_REAL_H

#include "scene/scene.h"

#include <tgmath.h> /* sqrt, pow and floor of either precision */

#ifdef TEXTBOOK_IN_FLOAT
typedef float Real;
#define textbook_pixel textbook_pixel_float
#define textbook_test textbook_test_float
#else
typedef double Real;
#endif

typedef struct Real3 {
    Real x, y, z;
} Real3;

/* P(t) = o + t r. */
typedef struct RealRay {
    Real3 o, r;
} RealRay;

/* The ray from the camera through the point (x, y) of the screen, measured from its centre. */
typedef struct ScreenRay {
    Real x, y;
    RealRay ray;
} ScreenRay;

typedef struct Hit {
    int face;     /* -1: none */
    Real n_dot_r; /* N.R */
    Real n_dot_o_plus_d, t;
    int edges; /* so many were looked at, up to the first that the point is outside of */
    Real edge[4];
    Real3 p;       /* the point */
    Real3 n;       /* N turned to the side that the ray came from */
    Real3 shifted; /* P moved off the face along N */
} Hit;

/* What one light adds, and the factors of it. */
typedef struct Terms {
    Real3 l, v, h; /* unit vectors to the light, to the viewer, and halfway between */
    Real l_dot_n, n_dot_h;
    Real3 ambient, diffuse, specular;
} Terms;

/* --- Vectors: an operation, a line --- */
/* clang-format off */

static Real3 rounded(Vec3 a) { return (Real3){(Real)a.x, (Real)a.y, (Real)a.z}; }
static Vec3 doubles(Real3 a) { return (Vec3){(double)a.x, (double)a.y, (double)a.z}; }
static Real3 add(Real3 a, Real3 b) { return (Real3){a.x + b.x, a.y + b.y, a.z + b.z}; }
static Real3 subtract(Real3 a, Real3 b) { return (Real3){a.x - b.x, a.y - b.y, a.z - b.z}; }
static Real3 scale(Real s, Real3 a) { return (Real3){s * a.x, s * a.y, s * a.z}; }
static Real3 divide(Real3 a, Real s) { return (Real3){a.x / s, a.y / s, a.z / s}; }
static Real3 multiply(Real3 a, Real3 b) { return (Real3){a.x * b.x, a.y * b.y, a.z * b.z}; }
static Real dot(Real3 a, Real3 b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
static Real at_least_zero(Real x) { return x > 0 ? x : 0; }

/* clang-format on */

static Real3 cross(Real3 a, Real3 b)
{
    return (Real3){a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

static Real3 vertex(const Face *face, int k)
{
    const float *v = face->vertices[k % face->vertex_count];
    return (Real3){(Real)v[0], (Real)v[1], (Real)v[2]};
}

/* a / |a|; zero stays zero. */
static Real3 unit(Real3 a)
{
    Real length = sqrt(dot(a, a));
    return length > 0 ? divide(a, length) : a;
}

#endif
