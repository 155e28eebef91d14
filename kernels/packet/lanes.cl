/* Lanes: LANES rays side by side in vector registers, one work-item for all of them.
 * LANES (1, 4, 8, 16) is a build option; one source serves them all. A CPU wants as many lanes as its registers hold, since
 * its compiler does not vectorise loops that differ between rays; a GPU wants 1. */
#include "shared/precision.cl"

/* Is that work left out where a scene does not need it? p: the Parameters. */
#define MAY_SKIP(p, skip) (!((p)->no_skip >> (skip) & 1))

/* Asks for cache lines ahead of their use. */
INLINE void fetch(global const void *p, uint bytes)
{
#if __has_builtin(__builtin_prefetch) && LANES > 1
    for (uint i = 0; i < bytes; i += 64)
        __builtin_prefetch((const void *)((size_t)p + i));
#endif
}

/* What is read from memory at every use: the compiler would make a vector of each value before a loop, more than there are
 * registers, and read those from memory instead. */
#if LANES > 1
#define REREAD volatile
#else
#define REREAD
#endif

/* One work-item holds PACKETS packets of LANES rays. Not unrolled: their code is long. */
#define EACH_OF(p, count) __attribute__((opencl_unroll_hint(1))) for (int p = 0; p < (count); p++)
#define EACH_PACKET(p) EACH_OF(p, PACKETS)

#define PASTE_(a, b) a##b
#define PASTE(a, b) PASTE_(a, b)

#if LANES == 1
typedef real Lanes;
typedef wide Wide;
typedef int Mask; /* all bits set: yes, 0: no; also holds the number of a face */
typedef int WideMask;
typedef int IntLanes;
#define TO_INT(x) ((int)(x))
#define AS_INT(x) as_int(x)
#define AS_LANES(x) as_float(x)
#define INTS_TO_LANES(x) ((real)(x))
#define INTS_TO_MASK(m) (m)
#define IS(comparison) (-(comparison))
#define TO_WIDE(x) ((wide)(x))
#define TO_REAL(x) ((real)(x))
#define TO_WIDE_MASK(m) (m)
#define TO_MASK(m) (m)
#define MASK_TO_WIDE(m) ((wide)(m))
#define LOAD_FLOATS(p) ((real)*(p))
#define LOAD(p) (*(p))
#define STORE(v, p) (*(p) = (v))
#else
#if REAL_DOUBLE
typedef PASTE(double, LANES) Lanes;
typedef PASTE(long, LANES) Mask;
#define TO_MASK(m) (m)
#define LOAD_FLOATS(p) PASTE(convert_double, LANES)(PASTE(vload, LANES)(0, p))
#else
typedef PASTE(float, LANES) Lanes;
typedef PASTE(int, LANES) Mask;
#define TO_MASK(m) PASTE(convert_int, LANES)(m)
#define LOAD_FLOATS(p) PASTE(vload, LANES)(0, p)
#endif
#if REAL_DOUBLE || HAS_DOUBLE
typedef PASTE(double, LANES) Wide;
typedef PASTE(long, LANES) WideMask;
#define TO_WIDE(x) PASTE(convert_double, LANES)(x)
#define MASK_TO_WIDE(m) PASTE(convert_double, LANES)(m)
#define TO_WIDE_MASK(m) PASTE(convert_long, LANES)(m)
#else
typedef PASTE(float, LANES) Wide;
typedef PASTE(int, LANES) WideMask;
#define TO_WIDE(x) (x)
#define MASK_TO_WIDE(m) PASTE(convert_float, LANES)(m)
#define TO_WIDE_MASK(m) (m)
#endif
#if REAL_DOUBLE
#define TO_REAL(x) (x)
#elif HAS_DOUBLE
#define TO_REAL(x) PASTE(convert_float, LANES)(x)
#else
#define TO_REAL(x) (x)
#endif
typedef PASTE(int, LANES) IntLanes;
#define TO_INT(x) PASTE(convert_int, LANES)(x)
#define AS_INT(x) PASTE(as_int, LANES)(x)
#define AS_LANES(x) PASTE(as_float, LANES)(x)
#define INTS_TO_LANES(x) PASTE(convert_float, LANES)(x)
#if REAL_DOUBLE
#define INTS_TO_MASK(m) PASTE(convert_long, LANES)(m)
#else
#define INTS_TO_MASK(m) (m)
#endif
#define IS(comparison) (comparison)
#define LOAD(p) PASTE(vload, LANES)(0, p)
#define STORE(v, p) PASTE(vstore, LANES)(v, 0, p)
#endif

#if REAL_DOUBLE && LANES > 1
typedef long MaskElement;
#else
typedef int MaskElement;
#endif

#if (REAL_DOUBLE || HAS_DOUBLE) && LANES > 1
typedef long WideMaskElement;
#else
typedef int WideMaskElement;
#endif

/* The number of each lane. */
INLINE Mask lane_numbers(void)
{
#if LANES == 16
    return (Mask)(0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15);
#elif LANES == 8
    return (Mask)(0, 1, 2, 3, 4, 5, 6, 7);
#elif LANES == 4
    return (Mask)(0, 1, 2, 3);
#else
    return 0;
#endif
}

/* One compare and one blend each; min() and max() of vectors cost twice that for their handling of NaN. */
#define LESSER(a, b) ((a) < (b) ? (a) : (b))
#define GREATER(a, b) ((a) > (b) ? (a) : (b))
#define FMA(a, b, c) fma((Lanes)(a), (Lanes)(b), (Lanes)(c))

typedef struct Vec {
    Lanes x, y, z;
} Vec;

typedef struct WideVec {
    Wide x, y, z;
} WideVec;

static Vec vec(Lanes x, Lanes y, Lanes z)
{
    Vec v = {x, y, z};
    return v;
}

static Vec vec_row(global const real *row) { return vec((Lanes)row[0], (Lanes)row[1], (Lanes)row[2]); }
static Vec vec_add(Vec a, Vec b) { return vec(a.x + b.x, a.y + b.y, a.z + b.z); }
static Vec vec_sub(Vec a, Vec b) { return vec(a.x - b.x, a.y - b.y, a.z - b.z); }
static Vec vec_scale(Lanes s, Vec a) { return vec(s * a.x, s * a.y, s * a.z); }
static Vec vec_multiply(Vec a, Vec b) { return vec(a.x * b.x, a.y * b.y, a.z * b.z); }
static Lanes vec_dot(Vec a, Vec b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
static Lanes vec_magnitudes(Vec a) { return fabs(a.x) + fabs(a.y) + fabs(a.z); }
static Lanes vec_largest(Vec a) { return GREATER(GREATER(fabs(a.x), fabs(a.y)), fabs(a.z)); }
static Vec vec_select(Mask mask, Vec a, Vec b) { return vec(mask ? a.x : b.x, mask ? a.y : b.y, mask ? a.z : b.z); }

static Vec vec_cross(Vec a, Vec b)
{
    return vec(a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x);
}

/* a / |a|; a zero vector stays zero. In double as the reference does it, in float with one division instead of three. */
static Vec vec_unit(Vec a)
{
    Lanes squared = vec_dot(a, a);
    Lanes length = squared > (Lanes)0 ? sqrt(squared) : (Lanes)1;
#if REAL_DOUBLE
    return vec(a.x / length, a.y / length, a.z / length);
#else
    return vec_scale(1 / length, a);
#endif
}

static WideVec wide_vec(Wide x, Wide y, Wide z)
{
    WideVec v = {x, y, z};
    return v;
}

static WideVec wide_add(WideVec a, WideVec b) { return wide_vec(a.x + b.x, a.y + b.y, a.z + b.z); }
static WideVec wide_sub(WideVec a, WideVec b) { return wide_vec(a.x - b.x, a.y - b.y, a.z - b.z); }
static WideVec wide_scale(Wide s, WideVec a) { return wide_vec(s * a.x, s * a.y, s * a.z); }
static Wide wide_dot(WideVec a, WideVec b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
static Wide wide_magnitudes(WideVec a) { return fabs(a.x) + fabs(a.y) + fabs(a.z); }

static WideVec wide_unit(WideVec a)
{
    Wide length = sqrt(wide_dot(a, a));
#if REAL_DOUBLE
    return wide_vec(a.x / length, a.y / length, a.z / length);
#else
    return wide_scale(1 / length, a);
#endif
}

static WideVec wide_select(WideMask mask, WideVec a, WideVec b)
{
    return wide_vec(mask ? a.x : b.x, mask ? a.y : b.y, mask ? a.z : b.z);
}

static Vec vec_to_real(WideVec a) { return vec(TO_REAL(a.x), TO_REAL(a.y), TO_REAL(a.z)); }

/* A mask as bits, lane 0 the lowest. One instruction where the processor has it. */
#ifndef __has_builtin
#define __has_builtin(x) 0
#endif
#if defined(__AVX512DQ__) && __has_builtin(__builtin_ia32_cvtd2mask512) && __has_builtin(__builtin_ia32_cvtq2mask512)
#define HAS_MOVEMASK 1
#endif

static uint mask_bits(Mask mask)
{
#if LANES == 1
    return mask & 1;
#elif HAS_MOVEMASK && LANES == 16 && !REAL_DOUBLE
    return (ushort)__builtin_ia32_cvtd2mask512(mask);
#elif HAS_MOVEMASK && LANES == 16 && REAL_DOUBLE
    return (uchar)__builtin_ia32_cvtq2mask512(mask.lo) | (uint)(uchar)__builtin_ia32_cvtq2mask512(mask.hi) << 8;
#elif HAS_MOVEMASK && LANES == 8 && REAL_DOUBLE
    return (uchar)__builtin_ia32_cvtq2mask512(mask);
#else
    MaskElement elements[LANES];
    STORE(mask, elements);
    uint bits = 0;
    for (int i = 0; i < LANES; i++)
        bits |= elements[i] ? 1u << i : 0u;
    return bits;
#endif
}

#define ANY(mask) (mask_bits(mask) != 0)

/* How many lanes of the mask are set. */
static uint mask_count(Mask mask) { return popcount(mask_bits(mask)); }

/* The number of the lowest bit that is set; there is one. */
static int lowest_bit(uint bits) { return 31 - (int)clz(bits & -bits); }

static wide first_wide(Wide x)
{
#if LANES == 1
    return x;
#else
    return x.s0;
#endif
}

/* The number in the first lane that is set in the mask. */
static int first_of(Mask numbers, Mask mask)
{
    MaskElement n[LANES];
    STORE(numbers, n);
    return (int)n[lowest_bit(mask_bits(mask))];
}

/* The lowest value of all lanes, by halves. */
static real lanes_lowest(Lanes x)
{
#if LANES == 1
    return x;
#else
#if LANES == 16
    PASTE(real, 8) x8 = LESSER(x.lo, x.hi);
    PASTE(real, 4) x4 = LESSER(x8.lo, x8.hi);
#elif LANES == 8
    PASTE(real, 4) x4 = LESSER(x.lo, x.hi);
#else
    Lanes x4 = x;
#endif
    PASTE(real, 2) x2 = LESSER(x4.lo, x4.hi);
    return LESSER(x2.x, x2.y);
#endif
}
