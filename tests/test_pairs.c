/* Pairs of floats, which stand for doubles on devices without them: kernels/pairs/pair.cl on the device here, against
 * rational numbers. Each bound is the one that the file states. The hard cases: sums that cancel, low parts of half an
 * ulp, numbers close to the largest and the smallest that a product may have. */
#include "support/pair_kernels.h"
#include "support/xorshift.h"

#include "unity.h"

#include <math.h>

enum { CASES = 20000, PAIR_IN = 4, PAIR_OUT = 6 };

static uint64_t state;

void setUp(void)
{
    state = 20261130;
}
void tearDown(void)
{
    pair_kernels_close();
}

/* --- Cases --- */

/* A float of 24 random bits, of that size. */
static float random_float(int exponent)
{
    int bits = (int)(random_next(&state) >> 40) | 1 << 23;
    return pair_sign(&state) * ldexpf((float)bits, exponent - 23);
}

/* What rounding took from a number: nothing, half an ulp, nearly half of one, or anything below. */
static float random_low(float high)
{
    int exponent;
    frexpf(high, &exponent);
    float half_ulp = ldexpf(1, exponent - 25);
    bool is_power = fabsf(high) == ldexpf(1, exponent - 1);
    if (is_power) /* below a power of two the next float is half as far */
        half_ulp /= 2;
    bool even = fmodf(ldexpf(fabsf(high), 24 - exponent), 2) == 0;
    switch (pair_pick(&state, 5)) {
    case 0:
        return 0;
    case 1:
        return even ? pair_sign(&state) * half_ulp : 0;
    case 2:
        return pair_sign(&state) * nextafterf(half_ulp, 0);
    case 3:
        return random_float(exponent - 27 - pair_pick(&state, 40));
    default:
        return random_float(exponent - 27);
    }
}

static void put_pair(float *pair, float high)
{
    pair[0] = high;
    pair[1] = random_low(high);
}

/* Two numbers that a sum, a product or a quotient finds hard. Their product is above 2^-96: its last bit is a float. */
static void put_case(float *in)
{
    put_pair(in, random_float(pair_pick(&state, 90) - 45));
    switch (pair_pick(&state, 6)) {
    case 0: /* the sum cancels, but for the low parts */
        put_pair(in + 2, -in[0]);
        break;
    case 1: /* the same, an ulp beside it */
        put_pair(in + 2, -nextafterf(in[0], pair_sign(&state) * INFINITY));
        break;
    case 2: /* one is far below the other */
        put_pair(in, random_float(pair_pick(&state, 90) - 32));
        put_pair(in + 2, in[0] * ldexpf(1, -22 - pair_pick(&state, 8)));
        break;
    case 3: /* close to the largest number */
        put_pair(in, random_float(62));
        put_pair(in + 2, random_float(63));
        break;
    case 4: /* powers of two */
        put_pair(in, pair_sign(&state) * ldexpf(1, pair_pick(&state, 60) - 30));
        put_pair(in + 2, pair_sign(&state) * ldexpf(1, pair_pick(&state, 60) - 30));
        break;
    default:
        put_pair(in + 2, random_float(pair_pick(&state, 90) - 45));
    }
}

/* --- Errors --- */

/* |found - exact| / |exact| in units of u^2 = 2^-48. */
static double error_of(const float *found, mpq_t exact)
{
    mpq_t value;
    mpq_init(value);
    pair_set(value, found[0], found[1]);
    mpq_sub(value, value, exact);
    if (mpq_sgn(exact) != 0)
        mpq_div(value, value, exact);
    double error = fabs(mpq_get_d(value)) * 0x1p48;
    mpq_clear(value);
    return error;
}

static void check_arithmetic(const double *bounds)
{
    static const char *const names[] = {"sum", "product", "quotient"};
    static float in[CASES * PAIR_IN], out[CASES * PAIR_OUT];
    double worst[3] = {0};
    for (int i = 0; i < CASES; i++)
        put_case(in + PAIR_IN * i);
    pair_kernels_run("arithmetic", CASES, in, sizeof in, out, sizeof out);
    mpq_t a, b, exact;
    mpq_inits(a, b, exact, NULL);
    for (int i = 0; i < CASES; i++) {
        pair_set(a, in[PAIR_IN * i], in[PAIR_IN * i + 1]);
        pair_set(b, in[PAIR_IN * i + 2], in[PAIR_IN * i + 3]);
        for (int k = 0; k < 3; k++) {
            const float *found = out + PAIR_OUT * i + 2 * k;
            (k == 0 ? mpq_add : k == 1 ? mpq_mul : mpq_div)(exact, a, b);
            worst[k] = fmax(worst[k], error_of(found, exact));
            TEST_ASSERT_TRUE_MESSAGE(found[0] + found[1] == found[0], names[k]);
        }
    }
    mpq_clears(a, b, exact, NULL);
    for (int k = 0; k < 3; k++) {
        TEST_ASSERT_TRUE_MESSAGE(worst[k] <= bounds[k], names[k]);
        /* The cases are hard: floats alone, or pairs whose low parts are not added up, are farther off. */
        TEST_ASSERT_TRUE_MESSAGE(worst[k] > 1, names[k]);
    }
}

static void arithmetic_should_meet_its_bounds(void)
{
    pair_kernels_open(false);
    check_arithmetic((const double[]){3.001, 5.001, 16});
}

static void a_quotient_should_meet_its_bound_where_division_is_poor(void)
{
    pair_kernels_open(true);
    check_arithmetic((const double[]){3.001, 5.001, 64});
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(arithmetic_should_meet_its_bounds);
    RUN_TEST(a_quotient_should_meet_its_bound_where_division_is_poor);
    return UNITY_END();
}
