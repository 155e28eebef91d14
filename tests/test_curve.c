/* Curves through keys: exact where the answer is known. */
#include "reader/scene_curve.h"

#include <math.h>
#include <unity.h>

void setUp(void) {}
void tearDown(void) {}

enum { KEYS = 5 };
static const double frames[KEYS] = {0, 3, 4, 11, 20};

static double at(const CurveKey *keys, int count, double (*value)(double), double frame)
{
    CurveShares shares = scene_curve_shares(keys, count, frame);
    double sum = 0, whole = 0;
    for (int i = 0; i < shares.count; i++) {
        TEST_ASSERT_TRUE(shares.first + i < count);
        sum += shares.share[i] * value(keys[shares.first + i].frame);
        whole += shares.share[i];
    }
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, 1, whole);
    return sum;
}

static void make_keys(CurveKey *keys, bool smooth)
{
    for (int i = 0; i < KEYS; i++)
        keys[i] = (CurveKey){frames[i], smooth};
}

static double line(double t)
{
    return 3 - 0.5 * t;
}

static double parabola(double t)
{
    return 2 - t + 0.25 * t * t;
}

static double cubic(double t)
{
    return t * t * t;
}

static void curve_should_be_exact_at_keys(void)
{
    CurveKey keys[KEYS];
    for (int smooth = 0; smooth < 2; smooth++) {
        make_keys(keys, smooth);
        for (int i = 0; i < KEYS; i++) {
            CurveShares shares = scene_curve_shares(keys, KEYS, frames[i]);
            TEST_ASSERT_EQUAL_INT(1, shares.count);
            TEST_ASSERT_EQUAL_INT(i, shares.first);
            TEST_ASSERT_TRUE(shares.share[0] == 1);
        }
    }
}

static void curve_should_rest_outside_its_keys(void)
{
    CurveKey keys[2] = {{5, true}, {9, true}};
    TEST_ASSERT_TRUE(at(keys, 2, line, 0) == line(5));
    TEST_ASSERT_TRUE(at(keys, 2, line, 100) == line(9));
    TEST_ASSERT_TRUE(at(keys, 1, line, 7) == line(5));
}

static void linear_curve_should_follow_the_chords(void)
{
    CurveKey keys[KEYS];
    make_keys(keys, false);
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, line(7), at(keys, KEYS, line, 7));
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, (parabola(4) * 4 + parabola(11) * 3) / 7, at(keys, KEYS, parabola, 7));
}

static void smooth_curve_should_follow_a_parabola_through_uneven_keys(void)
{
    CurveKey keys[KEYS];
    make_keys(keys, true);
    for (double t = 0; t <= 20; t += 0.25)
        TEST_ASSERT_DOUBLE_WITHIN(1e-10, parabola(t), at(keys, KEYS, parabola, t));
}

/* Between even keys it is the curve of the textbooks: at the middle (-p0 + 9 p1 + 9 p2 - p3) / 16. */
static void smooth_curve_should_be_catmull_and_rom_s(void)
{
    CurveKey keys[4] = {{0, true}, {2, true}, {4, true}, {6, true}};
    CurveShares shares = scene_curve_shares(keys, 4, 3);
    const double wanted[] = {-1 / 16.0, 9 / 16.0, 9 / 16.0, -1 / 16.0};
    TEST_ASSERT_EQUAL_INT(4, shares.count);
    for (int i = 0; i < 4; i++)
        TEST_ASSERT_DOUBLE_WITHIN(1e-15, wanted[i], shares.share[i]);
}

static double slope(const CurveKey *keys, double frame, double step)
{
    return (at(keys, KEYS, cubic, frame + step) - at(keys, KEYS, cubic, frame)) / step;
}

static void smooth_curve_should_have_no_corner_at_a_key(void)
{
    CurveKey keys[KEYS];
    make_keys(keys, true);
    for (int i = 1; i < KEYS - 1; i++)
        TEST_ASSERT_DOUBLE_WITHIN(1e-3, slope(keys, frames[i], -1e-6), slope(keys, frames[i], 1e-6));
    make_keys(keys, false);
    TEST_ASSERT_TRUE(fabs(slope(keys, 4, -1e-6) - slope(keys, 4, 1e-6)) > 100);
}

static void each_key_should_say_how_its_way_goes_on(void)
{
    CurveKey keys[KEYS];
    make_keys(keys, false);
    keys[2].smooth = true;
    TEST_ASSERT_DOUBLE_WITHIN(1e-10, parabola(7), at(keys, KEYS, parabola, 7));
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, (parabola(0) + parabola(3)) / 2, at(keys, KEYS, parabola, 1.5));
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(curve_should_be_exact_at_keys);
    RUN_TEST(curve_should_rest_outside_its_keys);
    RUN_TEST(linear_curve_should_follow_the_chords);
    RUN_TEST(smooth_curve_should_follow_a_parabola_through_uneven_keys);
    RUN_TEST(smooth_curve_should_be_catmull_and_rom_s);
    RUN_TEST(smooth_curve_should_have_no_corner_at_a_key);
    RUN_TEST(each_key_should_say_how_its_way_goes_on);
    return UNITY_END();
}
