/* Hit points in float, for shading and for shadow rays.
 *
 *     P - A = t R,   t = N.(v[0] - A) / N.R
 *
 * P is computed from the apex A of its ray, so that it does not matter how far from 0 the scene lies. It has an error
 * bound. Where the bound is more than APPROX_MOST of the distance to the light or to the viewer, the exact point of
 * points.cl takes its place. A city of 12 faces with 36 rays per pixel took 34 ms with exact points, and 24 ms with
 * these. docs/kernels.md, section 14. */
#include "shared/compiler.cl"
#include "shared/layout.h"
#include "shared/precision.cl"
#include "packet/faces.cl"
#include "packet/lanes.cl"
#include "packet/planes.cl"
#include "packet/vectors.cl"
#include "packet/world.cl"

#define HAS_APPROX (!ROUNDED_IS_POOR)
#define APPROX_MOST ((real)0x1p-14f)

typedef struct ApproxPoint {
    Vec from_apex; /* P - A */
    Lanes error;   /* the exact point is no farther away */
    Lanes length;  /* of the ray's direction */
} ApproxPoint;

/* N.(v[0] - A), for one apex of all lanes. It has no error worth mentioning. */
INLINE real approx_height(const World *world, int face, const wide *apex)
{
    global const wide *n = world->planes + (size_t)face * PLANE_REALS;
    global const real *v = face_row(world, face) + FACE_VERTICES;
    return (real)(n[0] * (v[0] - apex[0]) + n[1] * (v[4] - apex[1]) + n[2] * (v[8] - apex[2]));
}

/* The same for an apex of each lane. */
INLINE Lanes approx_heights(const World *world, int face, WideVec apex)
{
    global const wide *n = world->planes + (size_t)face * PLANE_REALS;
    global const real *v = face_row(world, face) + FACE_VERTICES;
    return TO_REAL(n[0] * ((wide)v[0] - apex.x) + n[1] * ((wide)v[4] - apex.y) + n[2] * ((wide)v[8] - apex.z));
}

/* How far an apex may be off after up to PATH_MAX mirrors, and a height over a plane. magnitudes: sums of their
 * coordinates'. */
#define APPROX_OFF(magnitudes) ((real)0x1p-41f * (magnitudes) + (real)0x1p-52f)

/* The error of t R. length: that of R; per_approach: |1 / N.R|; off: as APPROX_OFF. */
#define APPROX_ERROR(t, length, per_approach, off) \
    (((8 * REAL_ROUNDING) * (t) * (length) + (off)) * (1 + (length) * (per_approach)))

/* Where rays meet their faces. height: N.(v[0] - A); off: as APPROX_OFF; normal: N of the lanes' faces. Where rounding
 * may decide the sign of N.R, or that of t, the error is infinite. */
INLINE ApproxPoint approx_point(Vec ahead, Lanes height, Lanes off, Vec normal)
{
    ApproxPoint s;
    Lanes approach = FMA(ahead.x, normal.x, FMA(ahead.y, normal.y, ahead.z * normal.z));
    Lanes per_approach = 1 / approach, t = height * per_approach;
    s.length = sqrt(vec_dot(ahead, ahead));
    s.from_apex = vec_scale(t, ahead);
    Mask sure = IS(t > (Lanes)0) & IS(fabs(approach) > (16 * REAL_ROUNDING) * s.length);
    s.error = sure ? APPROX_ERROR(t, s.length, fabs(per_approach), off) : (Lanes)INFINITY;
    return s;
}

/* From the points to a place: unit vectors, 1 / the distance, and the error as a share of the distance. at: the place,
 * from the apex. False: some active lane's error is too large. */
INLINE bool approx_towards(const ApproxPoint *approx, Vec at, Mask active, Vec *unit, Lanes *per_length, Lanes *share)
{
    Vec d = vec_sub(at, approx->from_apex);
    *per_length = 1 / sqrt(vec_dot(d, d));
    *unit = vec_scale(*per_length, d);
    *share = (approx->error + 2 * REAL_ROUNDING * vec_largest(at)) * *per_length;
    return !ANY(active & ~IS(*share <= (Lanes)APPROX_MOST));
}

/* A place as seen from the apex: one of all rays; NULL: the apex of each lane. */
INLINE Vec from_apexes(const wide *place, const wide *apex, const WideVec *apexes)
{
    if (apex)
        return vec((Lanes)(real)(place[0] - apex[0]), (Lanes)(real)(place[1] - apex[1]),
                   (Lanes)(real)(place[2] - apex[2]));
    return vec(TO_REAL(place[0] - apexes->x), TO_REAL(place[1] - apexes->y), TO_REAL(place[2] - apexes->z));
}
