/* Arithmetic of pairs. A pair of floats is a number of some 48 bits: `high` is that number rounded, `low` what rounding
 * took. Devices without double compute in pairs what others compute in double.
 *
 *     u = 2^-24              relative error, at most
 *     sum, difference        3 u^2      Joldes, Muller and Popescu 2017, algorithm 6
 *     product                5 u^2      the same, algorithm 10; Muller and Rideau 2022
 *     quotient               64 u^2     where a / b of floats may be off by 2.5 ulp, as OpenCL allows
 *
 * Each bound holds where nothing leaves the range of floats. A compiler that joined a * b + c into one operation would
 * break all of them: shared/precision.cl forbids it. docs/bounds.md, "Pairs of floats". */
#include "shared/compiler.cl"
#include "shared/exact.cl"

INLINE Pair pair_of(float a)
{
    Pair p = {a, 0};
    return p;
}

/* Exact for whole numbers below 2^31. */
INLINE Pair pair_of_int(int n)
{
    Pair p = {(float)n, (float)(n - (int)(float)n)};
    return p;
}

/* a + b exactly, where |a| is not less than |b| (Dekker 1971). */
INLINE Pair quick_two_sum(float a, float b)
{
    Pair s;
    s.high = a + b;
    s.low = b - (s.high - a);
    return s;
}

INLINE Pair pair_minus(Pair a)
{
    Pair p = {-a.high, -a.low};
    return p;
}

INLINE Pair pair_sum(Pair a, Pair b)
{
    Pair high = two_sum(a.high, b.high), low = two_sum(a.low, b.low);
    Pair sum = quick_two_sum(high.high, high.low + low.high);
    return quick_two_sum(sum.high, low.low + sum.low);
}

INLINE Pair pair_difference(Pair a, Pair b) { return pair_sum(a, pair_minus(b)); }

INLINE Pair pair_product(Pair a, Pair b)
{
    Pair p = two_product(a.high, b.high);
    return quick_two_sum(p.high, p.low + (a.high * b.low + a.low * b.high));
}

INLINE Pair pair_quotient(Pair a, Pair b)
{
    float q = a.high / b.high;
    if (!isfinite(q))
        return pair_of(q);
    Pair rest = pair_difference(a, pair_product(b, pair_of(q)));
    return quick_two_sum(q, rest.high / b.high);
}

/* a 2^n, without rounding. */
INLINE Pair pair_ldexp(Pair a, int n)
{
    Pair p = {ldexp(a.high, n), ldexp(a.low, n)};
    return p;
}

INLINE bool pair_less(Pair a, Pair b) { return a.high < b.high || (a.high == b.high && a.low < b.low); }
INLINE bool pair_equal(Pair a, Pair b) { return a.high == b.high && a.low == b.low; }
