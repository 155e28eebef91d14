/* The exact oracle against a second exact method: the textbook's steps, P = O + t R and dot(N, cross(e, c)), in
 * rational numbers, on faces that are exactly planar. An oracle that is wrong would let every other test pass. */
#include "support/oracle.h"

#include "unity.h"

#include <gmp.h>
#include <math.h>
#include <stdint.h>
#include <string.h>

void setUp(void)
{
    oracle_integers_only = false;
}
void tearDown(void)
{
    oracle_free();
}

static uint64_t random_state = 1;

static uint64_t random_bits(void) /* splitmix64 (Steele, Lea and Flood 2014) */
{
    uint64_t z = (random_state += 0x9E3779B97F4A7C15u);
    z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9u;
    z = (z ^ (z >> 27)) * 0x94D049BB133111EBu;
    return z ^ (z >> 31);
}

static int random_int(int low, int high)
{
    return low + (int)(random_bits() % (uint64_t)(high - low + 1));
}

/* --- Vectors of rationals --- */

typedef mpq_t Rationals[3];

static void rationals_init(Rationals a)
{
    mpq_inits(a[0], a[1], a[2], NULL);
}
static void rationals_clear(Rationals a)
{
    mpq_clears(a[0], a[1], a[2], NULL);
}

static void rationals_set(Rationals a, const double *numbers)
{
    for (int i = 0; i < 3; i++)
        mpq_set_d(a[i], numbers[i]);
}

static void rationals_subtract(Rationals out, Rationals a, Rationals b)
{
    for (int i = 0; i < 3; i++)
        mpq_sub(out[i], a[i], b[i]);
}

static void rationals_cross(Rationals out, Rationals a, Rationals b)
{
    mpq_t product;
    mpq_init(product);
    for (int i = 0; i < 3; i++) {
        int j = (i + 1) % 3, k = (i + 2) % 3;
        mpq_mul(out[i], a[j], b[k]);
        mpq_mul(product, a[k], b[j]);
        mpq_sub(out[i], out[i], product);
    }
    mpq_clear(product);
}

static void rationals_dot(mpq_t out, Rationals a, Rationals b)
{
    mpq_t product;
    mpq_init(product);
    mpq_set_ui(out, 0, 1);
    for (int i = 0; i < 3; i++) {
        mpq_mul(product, a[i], b[i]);
        mpq_add(out, out, product);
    }
    mpq_clear(product);
}

/* --- The textbook, step by step --- */

typedef struct TextbookHit {
    bool hit;
    int side; /* of the origin */
    mpq_t t;  /* where the ray is not parallel */
    bool parallel;
} TextbookHit;

static void textbook_corners(Rationals *v, const float face[4][3], int count)
{
    for (int k = 0; k < count; k++) {
        const double numbers[3] = {(double)face[k][0], (double)face[k][1], (double)face[k][2]};
        rationals_init(v[k]);
        rationals_set(v[k], numbers);
    }
}

static bool textbook_inside(Rationals *v, int count, Rationals n, Rationals p)
{
    bool left = false, right = false;
    Rationals e, c, product;
    mpq_t sign;
    rationals_init(e);
    rationals_init(c);
    rationals_init(product);
    mpq_init(sign);
    for (int k = 0; k < count; k++) {
        rationals_subtract(e, v[(k + 1) % count], v[k]);
        rationals_subtract(c, p, v[k]);
        rationals_cross(product, e, c);
        rationals_dot(sign, n, product);
        left = left || mpq_sgn(sign) > 0;
        right = right || mpq_sgn(sign) < 0;
    }
    rationals_clear(e);
    rationals_clear(c);
    rationals_clear(product);
    mpq_clear(sign);
    return !(left && right);
}

/* The normal is that of two sides, (v1 - v0) x (v2 - v0). The caller clears t. */
static TextbookHit textbook_hit(const float face[4][3], int count, const double ray[6])
{
    TextbookHit result = {.hit = false};
    Rationals v[4], n, o, r, p, a, b;
    mpq_t height, approach;
    textbook_corners(v, face, count);
    rationals_init(n);
    rationals_init(o);
    rationals_init(r);
    rationals_init(p);
    rationals_init(a);
    rationals_init(b);
    mpq_inits(height, approach, result.t, NULL);
    rationals_set(o, ray);
    rationals_set(r, ray + 3);
    rationals_subtract(a, v[1], v[0]);
    rationals_subtract(b, v[2], v[0]);
    rationals_cross(n, a, b);
    rationals_subtract(a, o, v[0]);
    rationals_dot(height, n, a);
    rationals_dot(approach, n, r);
    result.side = mpq_sgn(height);
    result.parallel = mpq_sgn(approach) == 0;
    if (!result.parallel) {
        mpq_div(result.t, height, approach);
        mpq_neg(result.t, result.t);
        for (int i = 0; i < 3; i++) {
            mpq_mul(p[i], result.t, r[i]);
            mpq_add(p[i], p[i], o[i]);
        }
        result.hit = mpq_sgn(result.t) > 0 && textbook_inside(v, count, n, p);
    }
    for (int k = 0; k < count; k++)
        rationals_clear(v[k]);
    rationals_clear(n);
    rationals_clear(o);
    rationals_clear(r);
    rationals_clear(p);
    rationals_clear(a);
    rationals_clear(b);
    mpq_clears(height, approach, NULL);
    return result;
}

/* --- Faces and rays to try --- */

/* A parallelogram or a triangle on small integers: its sides span a plane exactly, and many rays meet its edges. */
static int small_face(float face[4][3], double scale)
{
    int corner[3], side[2][3];
    for (;;) {
        for (int i = 0; i < 3; i++) {
            corner[i] = random_int(-4, 4);
            side[0][i] = random_int(-3, 3);
            side[1][i] = random_int(-3, 3);
        }
        int x = side[0][1] * side[1][2] - side[0][2] * side[1][1],
            y = side[0][2] * side[1][0] - side[0][0] * side[1][2];
        if (x != 0 || y != 0 || side[0][0] * side[1][1] != side[0][1] * side[1][0])
            break;
    }
    int count = random_int(3, 4);
    for (int i = 0; i < 3; i++) {
        face[0][i] = (float)(scale * corner[i]);
        face[1][i] = (float)(scale * (corner[i] + side[0][i]));
        face[2][i] = (float)(scale * (corner[i] + side[0][i] + (count == 4 ? side[1][i] : 2 * side[1][i])));
        face[3][i] = count == 4 ? (float)(scale * (corner[i] + side[1][i])) : face[0][i];
    }
    return count;
}

static void small_ray(double ray[6], double scale)
{
    for (int i = 0; i < 6; i++)
        ray[i] = i < 3 ? scale * random_int(-5, 5) : random_int(-3, 3);
}

static double random_double(int exponent_range)
{
    return ldexp((double)(int64_t)random_bits(), -63 + random_int(-exponent_range, exponent_range));
}

static void random_triangle(float face[4][3], int exponent_range)
{
    for (int i = 0; i < 9; i++)
        face[i / 3][i % 3] = (float)random_double(exponent_range);
    memcpy(face[3], face[0], sizeof face[3]);
}

static void aim_at(double ray[6], const float face[4][3], int exponent_range)
{
    int k = random_int(0, 2);
    for (int i = 0; i < 3; i++) {
        double weight = (double)random_int(0, 4) / 4;
        double target = weight * (double)face[k][i] + (1 - weight) * (double)face[(k + 1) % 3][i];
        ray[i] = random_double(exponent_range);
        ray[3 + i] = target - ray[i];
    }
}

static void compare(const float face[4][3], int count, const double ray[6])
{
    TextbookHit textbook = textbook_hit(face, count, ray);
    TEST_ASSERT_EQUAL(textbook.hit, oracle_hits(face, ray));
    TEST_ASSERT_EQUAL(textbook.parallel, oracle_heading(face, ray) == 0);
    if (!textbook.parallel) {
        TEST_ASSERT_TRUE(fabs(mpq_get_d(textbook.t) - oracle_t(face, ray)) == 0);
        TEST_ASSERT_TRUE(fabs(oracle_t_error(face, ray, oracle_t(face, ray))) <= 0x1p-52 * fabs(oracle_t(face, ray)));
    }
    mpq_clear(textbook.t);
}

/* --- The tests --- */

static void oracle_should_agree_with_the_textbook_on_small_integers(void)
{
    for (int i = 0; i < 40000; i++) {
        float face[4][3];
        double ray[6], scale = ldexp(1, random_int(-60, 60));
        int count = small_face(face, scale);
        small_ray(ray, scale);
        oracle_integers_only = i % 2;
        compare((const float(*)[3])face, count, ray);
    }
}

static void oracle_should_agree_with_the_textbook_on_any_triangle(void)
{
    for (int i = 0; i < 20000; i++) {
        float face[4][3];
        double ray[6];
        random_triangle(face, i % 40);
        aim_at(ray, (const float(*)[3])face, i % 40);
        oracle_integers_only = i % 2;
        compare((const float(*)[3])face, 3, ray);
    }
}

static void oracle_should_order_two_hits_as_the_textbook(void)
{
    int ties = 0;
    for (int i = 0; i < 20000; i++) {
        float a[4][3], b[4][3];
        double ray[6];
        int a_count = small_face(a, 1), b_count = small_face(b, 1);
        small_ray(ray, 1);
        TextbookHit first = textbook_hit((const float(*)[3])a, a_count, ray);
        TextbookHit second = textbook_hit((const float(*)[3])b, b_count, ray);
        if (!first.parallel && !second.parallel) {
            int order = mpq_cmp(first.t, second.t);
            TEST_ASSERT_EQUAL((order > 0) - (order < 0), oracle_order((const float(*)[3])a, (const float(*)[3])b, ray));
            ties += order == 0;
        }
        mpq_clears(first.t, second.t, NULL);
    }
    TEST_ASSERT_GREATER_THAN(100, ties);
}

/* Strictly between two points means 0 < t < 1 on the ray from one to the other. */
static void oracle_should_block_as_the_textbook(void)
{
    int blocked_count = 0;
    for (int i = 0; i < 40000; i++) {
        float face[4][3];
        double ray[6], to[3];
        int count = small_face(face, 1);
        small_ray(ray, 1);
        for (int k = 0; k < 3; k++)
            to[k] = ray[k] + ray[3 + k];
        TextbookHit textbook = textbook_hit((const float(*)[3])face, count, ray);
        bool blocked = textbook.hit && mpq_cmp_si(textbook.t, 1, 1) < 0;
        oracle_integers_only = i % 2;
        TEST_ASSERT_EQUAL(blocked, oracle_blocks((const float(*)[3])face, ray, to));
        blocked_count += blocked;
        mpq_clear(textbook.t);
    }
    TEST_ASSERT_GREATER_THAN(200, blocked_count);
}

static void oracle_should_tell_the_side_as_the_textbook(void)
{
    int in_plane = 0;
    for (int i = 0; i < 20000; i++) {
        float face[4][3];
        double ray[6];
        int count = small_face(face, 1);
        small_ray(ray, 1);
        TextbookHit textbook = textbook_hit((const float(*)[3])face, count, ray);
        oracle_integers_only = i % 2;
        TEST_ASSERT_EQUAL(textbook.side, oracle_side((const float(*)[3])face, ray));
        in_plane += textbook.side == 0;
        mpq_clear(textbook.t);
    }
    TEST_ASSERT_GREATER_THAN(100, in_plane);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(oracle_should_agree_with_the_textbook_on_small_integers);
    RUN_TEST(oracle_should_agree_with_the_textbook_on_any_triangle);
    RUN_TEST(oracle_should_order_two_hits_as_the_textbook);
    RUN_TEST(oracle_should_block_as_the_textbook);
    RUN_TEST(oracle_should_tell_the_side_as_the_textbook);
    return UNITY_END();
}
