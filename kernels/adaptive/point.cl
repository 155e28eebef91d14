/* Points and vectors that all lanes have in common, in `wide`, and the slacks of what is computed with them. */
#include "shared/compiler.cl"
#include "shared/layout.h"
#include "shared/precision.cl"
#include "packet/faces.cl"
#include "packet/planes.cl"
#include "packet/world.cl"

/* More than all rounding, as a share of the magnitudes that meet in a value. WIDE_SLACK is for values in `wide`,
 * REAL_SLACK is what `real` adds to it, and BOX_SLACK is for boxes, in `real`. */
#if REAL_DOUBLE || HAS_DOUBLE
#define WIDE_SLACK 0x1p-38
#else
#define WIDE_SLACK 0x1p-18f
#endif
#if REAL_DOUBLE
#define REAL_SLACK (real)0
#define BOX_SLACK (real)0x1p-36
#else
#define REAL_SLACK (real)0x1p-20f
#define BOX_SLACK (real)0x1p-18f
#endif

typedef struct Point {
    wide x, y, z;
} Point;

INLINE Point point(wide x, wide y, wide z)
{
    Point p = {x, y, z};
    return p;
}

INLINE Point point_add(Point a, Point b) { return point(a.x + b.x, a.y + b.y, a.z + b.z); }
INLINE Point point_sub(Point a, Point b) { return point(a.x - b.x, a.y - b.y, a.z - b.z); }
INLINE Point point_scale(wide s, Point a) { return point(s * a.x, s * a.y, s * a.z); }
INLINE wide point_dot(Point a, Point b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
INLINE wide point_magnitudes(Point a) { return fabs(a.x) + fabs(a.y) + fabs(a.z); }

INLINE Point point_cross(Point a, Point b)
{
    return point(a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x);
}

INLINE Point face_point(const World *world, int face, int k)
{
    global const real *v = face_row(world, face) + k;
    return point((wide)v[0], (wide)v[4], (wide)v[8]);
}

INLINE Point face_normal(const World *world, int face)
{
    PlaneRow plane = plane_row(world, face);
    return point(plane.x, plane.y, plane.z);
}

INLINE int face_vertex_count(const World *world, int face)
{
    return face_bits(face_row(world, face)) & FACE_TRIANGLE ? 3 : 4;
}
