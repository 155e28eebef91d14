/* Random numbers, the same everywhere: xorshift64 (Marsaglia, "Xorshift RNGs", 2003). The state must not be 0. */
#ifndef RECTRAY_TESTS_XORSHIFT_H
#define RECTRAY_TESTS_XORSHIFT_H

#include <stdint.h>

static inline uint64_t random_next(uint64_t *state)
{
    *state ^= *state << 13;
    *state ^= *state >> 7;
    *state ^= *state << 17;
    return *state;
}

/* An integer in [-range, range]. */
static inline int64_t random_integer(uint64_t *state, int64_t range)
{
    return (int64_t)(random_next(state) % (uint64_t)(2 * range + 1)) - range;
}

/* In [-1, 1], a multiple of 2^-20: a float holds it. */
static inline double random_unit(uint64_t *state)
{
    return (double)random_integer(state, 1 << 20) / (1 << 20);
}

#endif
