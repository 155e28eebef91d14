/* Decimal numbers whose digits or power of ten are no doubles. The table of powers of five is made by exact arithmetic
 * with integers of 1024 bits, so that nobody has to trust 1302 constants. */
#include "base/number.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* w 10^q is 0 below these powers for any w of 64 bits, and infinite above. */
enum { LEAST_POWER = -342, GREATEST_POWER = 308, WORDS = 32 };

/* 128 bits. */
typedef struct Wide {
    uint64_t high, low;
} Wide;

/* 5^q, scaled by a power of two so that the highest of its 128 bits is set. Cut off, but rounded up for q from -27 to
 * -1: the proof of the method wants it so. */
static Wide powers_of_five[GREATEST_POWER - LEAST_POWER + 1];
static bool is_prepared;

/* --- The table --- */

/* An integer of 1024 bits, its lowest 32 bits first. */
typedef struct Big {
    uint32_t words[WORDS];
} Big;

static void times_five(Big *big)
{
    uint64_t carry = 0;
    for (int i = 0; i < WORDS; i++) {
        carry += (uint64_t)big->words[i] * 5;
        big->words[i] = (uint32_t)carry;
        carry >>= 32;
    }
}

/* Rounds down: and so does any number of these divisions, compared with one by their product. */
static void divided_by_five(Big *big)
{
    uint64_t rest = 0;
    for (int i = WORDS - 1; i >= 0; i--) {
        rest = rest << 32 | big->words[i];
        big->words[i] = (uint32_t)(rest / 5);
        rest %= 5;
    }
}

/* The 32 bits from bit `from` on, counted from the lowest; bits below bit 0 are 0. */
static uint64_t bits_from(const Big *big, int from)
{
    int word = from >= 0 ? from / 32 : -((31 - from) / 32), shift = from - 32 * word;
    uint64_t low = word >= 0 ? big->words[word] : 0;
    uint64_t high = word >= -1 && word + 1 < WORDS ? big->words[word + 1] : 0;
    return (high << 32 | low) >> shift & 0xFFFFFFFF;
}

static Wide highest_bits(const Big *big)
{
    int top = WORDS * 32;
    while (!(big->words[(top - 1) / 32] >> (top - 1) % 32 & 1))
        top--;
    return (Wide){bits_from(big, top - 32) << 32 | bits_from(big, top - 64),
                  bits_from(big, top - 96) << 32 | bits_from(big, top - 128)};
}

void number_prepare(void)
{
    if (is_prepared)
        return;
    Big power = {{1}}, inverse = {{[WORDS - 1] = 0x80000000}};
    for (int q = 0; q <= GREATEST_POWER; q++, times_five(&power))
        powers_of_five[q - LEAST_POWER] = highest_bits(&power);
    for (int q = -1; q >= LEAST_POWER; q--) {
        divided_by_five(&inverse);
        Wide *wide = &powers_of_five[q - LEAST_POWER];
        *wide = highest_bits(&inverse);
        if (q >= -27)
            wide->high += ++wide->low == 0;
    }
    is_prepared = true;
}

/* --- A value --- */

static Wide product(uint64_t a, uint64_t b)
{
    uint64_t a_low = a & 0xFFFFFFFF, a_high = a >> 32, b_low = b & 0xFFFFFFFF, b_high = b >> 32;
    uint64_t low = a_low * b_low, middle = a_high * b_low + (low >> 32);
    uint64_t other = a_low * b_high + (middle & 0xFFFFFFFF);
    return (Wide){a_high * b_high + (middle >> 32) + (other >> 32), other << 32 | (low & 0xFFFFFFFF)};
}

static int leading_zeros(uint64_t w)
{
    int zeros = 0;
    for (int step = 32; step > 0; step /= 2)
        if (!(w >> (64 - step))) {
            zeros += step;
            w <<= step;
        }
    return zeros;
}

/* w 5^q but for a power of two, w being normalised: to 64 bits, and all of them where the 55 highest do not decide. */
static Wide scaled_product(uint64_t w, Wide power)
{
    Wide scaled = product(w, power.high);
    if ((scaled.high & 0x1FF) == 0x1FF) {
        uint64_t more = product(w, power.low).high;
        scaled.low += more;
        scaled.high += scaled.low < more;
    }
    return scaled;
}

/* Lemire 2021, algorithm 1: the nearest double of w 10^q, w > 0. False where it is not a normal one. That the 128 bits
 * always decide is proved in Mushtak and Lemire, "Fast number parsing without fallback", 2023. */
static bool nearest_normal(uint64_t w, int q, double *value)
{
    if (q < LEAST_POWER || q > GREATEST_POWER)
        return false;
    int zeros = leading_zeros(w);
    Wide scaled = scaled_product(w << zeros, powers_of_five[q - LEAST_POWER]);
    int upper_bit = (int)(scaled.high >> 63);
    uint64_t mantissa = scaled.high >> (upper_bit + 9); /* 53 bits, and one to round by */
    /* 217706 / 2^16 is log2(10): the exponent of the highest bit of 10^q, rounded down, is exact for these q. */
    int floor_log = q >= 0 ? 217706 * q / 65536 : -((-217706 * q + 65535) / 65536);
    int exponent = floor_log + 63 + upper_bit - zeros + 1023;
    if (exponent <= 0)
        return false;
    /* Half-way between two doubles, which only these powers can be: to the even one. */
    if (scaled.low <= 1 && q >= -4 && q <= 23 && (mantissa & 3) == 1 && mantissa << (upper_bit + 9) == scaled.high)
        mantissa &= ~(uint64_t)1;
    mantissa = (mantissa + (mantissa & 1)) >> 1;
    if (mantissa == (uint64_t)1 << 53) {
        mantissa >>= 1;
        exponent++;
    }
    if (exponent >= 2047)
        return false;
    uint64_t bits = (mantissa & (((uint64_t)1 << 52) - 1)) | (uint64_t)exponent << 52;
    memcpy(value, &bits, sizeof bits);
    return true;
}

/* Leading zeros are no digits that count. */
static int significant_digits(const Decimal *decimal)
{
    int count = decimal->digit_count;
    for (const char *c = decimal->point_or_digits; c < decimal->end && (*c == '0' || *c == '.'); c++)
        count -= *c == '0';
    return count;
}

bool number_convert(const Decimal *decimal, double *value)
{
    bool all_digits = significant_digits(decimal) <= 19;
    if (all_digits && decimal->digits == 0)
        *value = 0;
    else if (!all_digits || !is_prepared || !nearest_normal(decimal->digits, decimal->exponent, value)) {
        *value = strtod(decimal->start, NULL);
        return isfinite(*value);
    }
    if (decimal->negative)
        *value = -*value;
    return true;
}
