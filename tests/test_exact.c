/* Exact signs of determinants, against integers. A lattice of long vectors that nearly coincide gives determinants
 * whose value is small and known, while each of their six products is so large that plain doubles lose it. */
#include "scene/exact.h"

#include "support/xorshift.h"

#include "unity.h"

void setUp(void) {}
void tearDown(void) {}

typedef struct Integers {
    int64_t x, y, z;
} Integers;

static Integers random_integers(uint64_t *state, int64_t range)
{
    Integers a = {random_integer(state, range), random_integer(state, range), random_integer(state, range)};
    return a;
}

static Integers integers_add(Integers a, Integers b)
{
    return (Integers){a.x + b.x, a.y + b.y, a.z + b.z};
}

static Vec3 vec3_from(Integers a)
{
    return vec3((double)a.x, (double)a.y, (double)a.z);
}

/* a . (b x c), of which every partial sum must fit 64 bits. */
static int64_t integer_determinant(Integers a, Integers b, Integers c)
{
    return a.x * (b.y * c.z - b.z * c.y) + a.y * (b.z * c.x - b.x * c.z) + a.z * (b.x * c.y - b.y * c.x);
}

static int integer_sign(int64_t x)
{
    return (x > 0) - (x < 0);
}

static int plain_sign(Vec3 a, Vec3 b, Vec3 c)
{
    double value = vec3_dot(a, vec3_cross(b, c));
    return (value > 0) - (value < 0);
}

static int determinant_sign(ExactVec3 a, ExactVec3 b, ExactVec3 c)
{
    double value = exact_determinant(a, b, c);
    return (value > 0) - (value < 0);
}

static int exact_sign(Vec3 a, Vec3 b, Vec3 c)
{
    return determinant_sign(exact_vec3(a), exact_vec3(b), exact_vec3(c));
}

static void determinant_of_the_axes_should_be_positive(void)
{
    TEST_ASSERT_EQUAL_INT(1, exact_sign(vec3(1, 0, 0), vec3(0, 1, 0), vec3(0, 0, 1)));
    TEST_ASSERT_EQUAL_INT(-1, exact_sign(vec3(0, 1, 0), vec3(1, 0, 0), vec3(0, 0, 1)));
    TEST_ASSERT_EQUAL_INT(-1, exact_sign(vec3(-1, 0, 0), vec3(0, 1, 0), vec3(0, 0, 1)));
}

static void determinant_of_dependent_vectors_should_be_zero(void)
{
    TEST_ASSERT_EQUAL_INT(0, exact_sign(vec3(0, 0, 0), vec3(1, 2, 3), vec3(4, 5, 6)));
    TEST_ASSERT_EQUAL_INT(0, exact_sign(vec3(1, 2, 3), vec3(4, 5, 6), vec3(1, 2, 3)));
    /* 0.1, 0.2 and 0.3 are not what they say, but these rows are equal in every bit up to a factor of 2. */
    TEST_ASSERT_EQUAL_INT(0, exact_sign(vec3(0.1, 0.2, 0.3), vec3(0.7, 0.11, 1e9), vec3(0.2, 0.4, 0.6)));
}

static void determinant_should_agree_with_small_integers(void)
{
    uint64_t state = 20240601;
    for (int i = 0; i < 20000; i++) {
        int64_t range = i % 2 ? 3 : 1 << 20; /* small ones are often zero */
        Integers a = random_integers(&state, range), b = random_integers(&state, range),
                 c = random_integers(&state, range);
        int expected = integer_sign(integer_determinant(a, b, c));
        TEST_ASSERT_EQUAL_INT(expected, exact_sign(vec3_from(a), vec3_from(b), vec3_from(c)));
    }
}

/* det(a, a + d, a + e) = det(a, d, e): products of 2^120 whose sum is below 2^56. */
static void determinant_should_be_exact_where_doubles_get_the_sign_wrong(void)
{
    uint64_t state = 7;
    int wrong_in_doubles = 0, zeros = 0;
    for (int i = 0; i < 20000; i++) {
        Integers a = random_integers(&state, (int64_t)1 << 40);
        Integers d = random_integers(&state, 16), e = random_integers(&state, 16);
        if (i % 8 == 0)
            e = (Integers){-2 * d.x, -2 * d.y, -2 * d.z};
        int expected = integer_sign(integer_determinant(a, d, e));
        Vec3 x = vec3_from(a), y = vec3_from(integers_add(a, d)), z = vec3_from(integers_add(a, e));
        TEST_ASSERT_EQUAL_INT(expected, exact_sign(x, y, z));
        wrong_in_doubles += plain_sign(x, y, z) != expected;
        zeros += expected == 0;
    }
    TEST_ASSERT_GREATER_THAN(5000, wrong_in_doubles); /* else this test would prove nothing */
    TEST_ASSERT_GREATER_THAN(2000, zeros);
}

static void determinant_should_turn_with_each_swap_and_stay_under_scaling(void)
{
    uint64_t state = 99;
    for (int i = 0; i < 2000; i++) {
        Integers lattice = random_integers(&state, (int64_t)1 << 40);
        Vec3 a = vec3_from(lattice);
        Vec3 b = vec3_from(integers_add(lattice, random_integers(&state, 4)));
        Vec3 c = vec3_from(integers_add(lattice, random_integers(&state, 4)));
        int sign = exact_sign(a, b, c);
        TEST_ASSERT_EQUAL_INT(sign, exact_sign(b, c, a));
        TEST_ASSERT_EQUAL_INT(-sign, exact_sign(b, a, c));
        TEST_ASSERT_EQUAL_INT(-sign, exact_sign(vec3_negate(a), b, c));
        TEST_ASSERT_EQUAL_INT(sign, exact_sign(vec3_scale(0x1p-200, a), vec3_scale(0x1p+150, b), c));
    }
}

static void difference_should_keep_what_a_double_drops(void)
{
    ExactVec3 d = exact_difference(vec3(0x1p80, 1, 0.1), vec3(3, 0x1p-70, 0.1));
    TEST_ASSERT_TRUE(d.high.x == 0x1p80 && d.low.x == -3);
    TEST_ASSERT_TRUE(d.high.y == 1 && d.low.y == -0x1p-70);
    TEST_ASSERT_TRUE(d.high.z == 0 && d.low.z == 0);
}

/* (2^80 - 3) 1 1 - 2^80 1 1 = -3, which the rounded differences call zero. */
static void determinant_should_count_the_low_parts(void)
{
    ExactVec3 a = exact_difference(vec3(0x1p80, 0x1p80, 0), vec3(3, 0, 0));
    Vec3 b = vec3(1, 1, 0), c = vec3(0, 0, 1);
    TEST_ASSERT_EQUAL_INT(-1, determinant_sign(a, exact_vec3(b), exact_vec3(c)));
    TEST_ASSERT_EQUAL_INT(0, exact_sign(a.high, b, c));
    TEST_ASSERT_EQUAL_INT(-1, determinant_sign(exact_vec3(c), a, exact_vec3(b)));
    TEST_ASSERT_EQUAL_INT(-1, determinant_sign(exact_vec3(b), exact_vec3(c), a));
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(determinant_of_the_axes_should_be_positive);
    RUN_TEST(determinant_of_dependent_vectors_should_be_zero);
    RUN_TEST(determinant_should_agree_with_small_integers);
    RUN_TEST(determinant_should_be_exact_where_doubles_get_the_sign_wrong);
    RUN_TEST(determinant_should_turn_with_each_swap_and_stay_under_scaling);
    RUN_TEST(difference_should_keep_what_a_double_drops);
    RUN_TEST(determinant_should_count_the_low_parts);
    return UNITY_END();
}
