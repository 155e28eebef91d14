/* The scale of heatmaps. */
#include "picture/heat.h"

#include "unity.h"

void setUp(void) {}
void tearDown(void) {}

/* The brightness of a colour as Green (2011) takes it: that of the three channels, weighted as the eye does. */
static double brightness(double heat)
{
    unsigned char rgb[3];
    heat_colour(heat, rgb);
    return 0.30 * rgb[0] + 0.59 * rgb[1] + 0.11 * rgb[2];
}

/* Each channel is rounded to a byte, by half a step at most; no channel leaves the cube. */
static void colours_should_be_as_bright_as_their_numbers(void)
{
    for (int i = 0; i <= 1000; i++)
        TEST_ASSERT_DOUBLE_WITHIN(0.5 + 1e-9, 255 * i / 1000.0, brightness(i / 1000.0));
}

static void equal_should_be_black_and_one_step_plainly_seen(void)
{
    TEST_ASSERT_EQUAL_DOUBLE(0, brightness(heat_of_difference(0)));
    TEST_ASSERT_DOUBLE_WITHIN(1, 64, brightness(heat_of_difference(1)));
    TEST_ASSERT_EQUAL_DOUBLE(255, brightness(heat_of_difference(255)));
    TEST_ASSERT_DOUBLE_WITHIN(1e-3, (0.25 + 1) / 2, heat_of_difference(16)); /* 16^2 is about 255 */
}

static void larger_differences_should_be_hotter(void)
{
    for (int difference = 1; difference <= 255; difference++)
        TEST_ASSERT_TRUE(heat_of_difference(difference) > heat_of_difference(difference - 1));
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(colours_should_be_as_bright_as_their_numbers);
    RUN_TEST(equal_should_be_black_and_one_step_plainly_seen);
    RUN_TEST(larger_differences_should_be_hotter);
    return UNITY_END();
}
