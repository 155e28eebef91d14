/* Vectors of all lanes: Vec in `real`, WideVec in `wide`. A register holds one component of all lanes, so that the
 * formulas read like those of single vectors. */
#include "shared/compiler.cl"
#include "shared/precision.cl"
#include "packet/lanes.cl"

typedef struct Vec {
    Lanes x, y, z;
} Vec;

typedef struct WideVec {
    Wide x, y, z;
} WideVec;

INLINE Vec vec(Lanes x, Lanes y, Lanes z)
{
    Vec v = {x, y, z};
    return v;
}

INLINE Vec vec_row(global const real *row) { return vec((Lanes)row[0], (Lanes)row[1], (Lanes)row[2]); }
INLINE Vec vec_add(Vec a, Vec b) { return vec(a.x + b.x, a.y + b.y, a.z + b.z); }
INLINE Vec vec_sub(Vec a, Vec b) { return vec(a.x - b.x, a.y - b.y, a.z - b.z); }
INLINE Vec vec_minus(Vec a) { return vec(-a.x, -a.y, -a.z); }
INLINE Vec vec_scale(Lanes s, Vec a) { return vec(s * a.x, s * a.y, s * a.z); }
INLINE Lanes vec_dot(Vec a, Vec b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
INLINE Lanes vec_magnitudes(Vec a) { return fabs(a.x) + fabs(a.y) + fabs(a.z); }
INLINE Lanes vec_largest(Vec a) { return GREATER(GREATER(fabs(a.x), fabs(a.y)), fabs(a.z)); }
INLINE Vec vec_select(Mask mask, Vec a, Vec b) { return vec(mask ? a.x : b.x, mask ? a.y : b.y, mask ? a.z : b.z); }

/* a / |a|. A zero vector stays zero. Double does as the reference does; float takes one division instead of three. */
INLINE Vec vec_unit(Vec a)
{
    Lanes squared = vec_dot(a, a);
    Lanes length = squared > (Lanes)0 ? sqrt(squared) : (Lanes)1;
#if REAL_DOUBLE
    return vec(a.x / length, a.y / length, a.z / length);
#else
    return vec_scale(1 / length, a);
#endif
}

INLINE WideVec wide_vec(Wide x, Wide y, Wide z)
{
    WideVec v = {x, y, z};
    return v;
}

/* A point that all lanes have in common. */
INLINE WideVec wide_of(const wide *p) { return wide_vec((Wide)p[0], (Wide)p[1], (Wide)p[2]); }

/* |x| + |y| + |z|. */
INLINE wide magnitudes_of(const wide *p) { return fabs(p[0]) + fabs(p[1]) + fabs(p[2]); }

INLINE WideVec wide_add(WideVec a, WideVec b) { return wide_vec(a.x + b.x, a.y + b.y, a.z + b.z); }
INLINE WideVec wide_sub(WideVec a, WideVec b) { return wide_vec(a.x - b.x, a.y - b.y, a.z - b.z); }
INLINE WideVec wide_minus(WideVec a) { return wide_vec(-a.x, -a.y, -a.z); }
INLINE WideVec wide_scale(Wide s, WideVec a) { return wide_vec(s * a.x, s * a.y, s * a.z); }
INLINE Wide wide_dot(WideVec a, WideVec b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
INLINE Wide wide_magnitudes(WideVec a) { return fabs(a.x) + fabs(a.y) + fabs(a.z); }

INLINE WideVec wide_unit(WideVec a)
{
    Wide length = sqrt(wide_dot(a, a));
#if REAL_DOUBLE
    return wide_vec(a.x / length, a.y / length, a.z / length);
#else
    return wide_scale(1 / length, a);
#endif
}

INLINE WideVec wide_select(WideMask mask, WideVec a, WideVec b)
{
    return wide_vec(mask ? a.x : b.x, mask ? a.y : b.y, mask ? a.z : b.z);
}

INLINE Vec vec_to_real(WideVec a) { return vec(TO_REAL(a.x), TO_REAL(a.y), TO_REAL(a.z)); }

/* The value in lane 0. */
INLINE wide first_wide(Wide x)
{
#if LANES == 1
    return x;
#else
    return x.s0;
#endif
}
