/* Lanes: LANES rays lie side by side in vector registers, and one work-item traces all of them. LANES is a build
 * option: 1, 4, 8 or 16. A CPU wants as many lanes as its registers hold, since its compiler does not vectorise loops
 * that run differently for different rays. A GPU wants 1.
 *
 *     Lanes     a real of each ray              Wide      a wide of each ray
 *     Mask      yes (all bits set) or no (0)    WideMask  the same, as wide as Wide
 *
 * `mask ? a : b` takes each lane from a or from b. A Mask also holds whole numbers: that of a face, for instance. */
#include "shared/compiler.cl"
#include "shared/precision.cl"

/* One work-item holds PACKETS packets of LANES rays. */
#define EACH_PACKET(p) EACH_OF(p, PACKETS)

#define PASTE_(a, b) a##b
#define PASTE(a, b) PASTE_(a, b)

#if LANES == 1
typedef real Lanes;
typedef wide Wide;
typedef int Mask;
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

/* Of a kernel: a compiler that would put several work-items side by side is told that the lanes fill its registers
 * already. Without it, one took ten times as long to compile. */
#define FULL_LANES __attribute__((vec_type_hint(Lanes)))

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

/* One comparison and one blend each. min() and max() of vectors cost twice that, since they treat NaN specially. */
#define LESSER(a, b) ((a) < (b) ? (a) : (b))
#define GREATER(a, b) ((a) > (b) ? (a) : (b))
#define FMA(a, b, c) fma((Lanes)(a), (Lanes)(b), (Lanes)(c))

/* A mask as bits, lane 0 the lowest: one instruction where the processor has it. */
#if defined(__AVX512DQ__) && __has_builtin(__builtin_ia32_cvtd2mask512) && __has_builtin(__builtin_ia32_cvtq2mask512)
#define HAS_MOVEMASK 1
#endif

INLINE uint mask_bits(Mask mask)
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
INLINE uint mask_count(Mask mask) { return popcount(mask_bits(mask)); }

/* The number of the lowest bit that is set. There is one. */
INLINE int lowest_bit(uint bits) { return 31 - (int)clz(bits & -bits); }

/* The number in the first lane of the mask. There is one. */
INLINE int first_of(Mask numbers, Mask mask)
{
    MaskElement n[LANES];
    STORE(numbers, n);
    return (int)n[lowest_bit(mask_bits(mask))];
}

/* Takes those lanes out of `rest` whose number is that of its first lane. */
INLINE Mask take_same(Mask numbers, Mask *rest, int *number)
{
    *number = first_of(numbers, *rest);
    Mask same = *rest & IS(numbers == (Mask)*number);
    *rest &= ~same;
    return same;
}

INLINE real real_at(Lanes x, int lane)
{
    real values[LANES];
    STORE(x, values);
    return values[lane];
}

INLINE wide wide_at(Wide x, int lane)
{
    wide values[LANES];
    STORE(x, values);
    return values[lane];
}

/* The lowest value of all lanes, by halves: with LESSER and mask_bits, that took a quarter from the time of gallery. */
INLINE real lanes_lowest(Lanes x)
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

INLINE bool any_packet(const Mask *masks)
{
    Mask any = masks[0];
    for (int p = 1; p < PACKETS; p++)
        any |= masks[p];
    return ANY(any);
}

/* The first packet that has a lane set. There is one. */
INLINE int first_packet(const Mask *masks)
{
    int first = 0;
    while (!ANY(masks[first]))
        first++;
    return first;
}
