/* Powers, for highlights (Muller, "Elementary Functions", third edition, chapter 3).
 *
 *     x^y = 2^(y log2 x)
 *
 * The logarithm and the power of 2 are polynomials of least relative error, which Remez' algorithm gives. PoCL's log2
 * fetches entries of a table lane by lane: `original` took 8.8 ms with it, and 7.2 ms with these. */
#include "shared/compiler.cl"
#include "shared/precision.cl"
#include "packet/lanes.cl"

#if !REAL_DOUBLE
/* log2 x = e + log2 m, with m between 2/3 and 4/3. The relative error is at most 3e-8. x: at least FLT_MIN. */
INLINE Lanes log2_of(Lanes x)
{
    IntLanes bits = AS_INT(x), exponent = (bits - 0x3f2aaaab) >> 23;
    Lanes f = AS_LANES(bits - (exponent << 23)) - 1;
    Lanes p = FMA(f, 0.20825224f, -0.22222167f);
    p = FMA(f, p, 0.20058458f);
    p = FMA(f, p, -0.23678643f);
    p = FMA(f, p, 0.28879568f);
    p = FMA(f, p, -0.36078957f);
    p = FMA(f, p, 0.48089409f);
    p = FMA(f, p, -0.72134656f);
    p = FMA(f, p, 1.442695f);
    return FMA(f, p, INTS_TO_LANES(exponent));
}

/* 2^x = 2^n 2^r, with r between -1/2 and 1/2. The relative error is at most 2e-9. x: between -126 and 126. */
INLINE Lanes exp2_of(Lanes x)
{
    const real shift = 0x1.8p23f; /* the sum with it is rounded to a whole number */
    Lanes sum = x + shift, r = x - (sum - shift);
    Lanes p = FMA(r, 0.00015345812f, 0.0013399931f);
    p = FMA(r, p, 0.009618489f);
    p = FMA(r, p, 0.055503286f);
    p = FMA(r, p, 0.24022646f);
    p = FMA(r, p, 0.6931472f);
    p = FMA(r, p, 1.0f);
    return AS_LANES(AS_INT(p) + (AS_INT(sum) << 23));
}
#endif

/* x^y for y >= 0, and x 0 or from FLT_MIN to some ulps above 1. In float the relative error is at most 1.2e-7. In
 * double it is done lane by lane: PoCL 3.1's pow of vectors of doubles is wrong where the lanes take different
 * branches of it. */
static Lanes power(Lanes x, real y)
{
#if !REAL_DOUBLE
    if (!(y > 0))
        return (Lanes)1;
    Lanes z = y * log2_of(GREATER(x, (Lanes)FLT_MIN));
    return (IS(x > (Lanes)0) & IS(z > (Lanes)-126)) ? exp2_of(LESSER(z, (Lanes)126)) : (Lanes)0;
#elif LANES == 1
    return pow(x, y);
#else
    real base[LANES];
    STORE(x, base);
    for (int i = 0; i < LANES; i++)
        base[i] = pow(base[i], y);
    return LOAD(base);
#endif
}
