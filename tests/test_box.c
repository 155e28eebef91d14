/* Boxes, and the part of a ray inside one. */
#include "scene/box.h"

#include "unity.h"

#include <float.h>
#include <stdbool.h>

static const Box UNIT = {{0, 0, 0}, {1, 1, 1}};

void setUp(void) {}
void tearDown(void) {}

static bool is_empty(Interval interval)
{
    return !(interval.enter <= interval.leave);
}

static void interval_should_reach_a_little_beyond_the_exact_one(void)
{
    Interval inside = interval_in_box(UNIT, vec3(-1, 0.5, 0.5), vec3(3, 0, 0));
    TEST_ASSERT_DOUBLE_WITHIN(1e-15, 1 / 3.0, inside.enter);
    TEST_ASSERT_DOUBLE_WITHIN(1e-15, 2 / 3.0, inside.leave);
    TEST_ASSERT_TRUE(inside.enter < (1 - DBL_EPSILON) / 3 && inside.leave > (2 + DBL_EPSILON) / 3);
}

static void interval_should_not_depend_on_the_way_round(void)
{
    Interval inside = interval_in_box(UNIT, vec3(2, 0.5, 0.5), vec3(-2, 0, 0));
    TEST_ASSERT_DOUBLE_WITHIN(1e-15, 0.5, inside.enter);
    TEST_ASSERT_DOUBLE_WITHIN(2e-15, 1, inside.leave);
}

static void interval_should_begin_at_0_where_the_ray_starts_inside(void)
{
    Interval inside = interval_in_box(UNIT, vec3(0.5, 0.5, 0.5), vec3(1, -1, 0.25));
    TEST_ASSERT_TRUE(inside.enter == 0);
    TEST_ASSERT_DOUBLE_WITHIN(1e-15, 0.5, inside.leave);
}

static void interval_should_be_empty_behind_and_beside_the_ray(void)
{
    TEST_ASSERT_TRUE(is_empty(interval_in_box(UNIT, vec3(2, 0.5, 0.5), vec3(1, 0, 0))));
    TEST_ASSERT_TRUE(is_empty(interval_in_box(UNIT, vec3(-1, 1.25, 0.5), vec3(1, 0, 0))));
    TEST_ASSERT_TRUE(is_empty(interval_in_box(UNIT, vec3(-1, -1, 0.5), vec3(1, 3, 0))));
    TEST_ASSERT_TRUE(is_empty(interval_in_box(box_empty(), vec3(0, 0, 0), vec3(1, 1, 1))));
}

static void rays_in_a_side_of_the_box_should_be_inside(void)
{
    for (int k = 0; k < 4; k++) {
        Vec3 origin = vec3(-1, k & 1, k >> 1);
        Interval inside = interval_in_box(UNIT, origin, vec3(1, -0.0, 0));
        TEST_ASSERT_DOUBLE_WITHIN(2e-15, 1, inside.enter);
        TEST_ASSERT_DOUBLE_WITHIN(2e-15, 2, inside.leave);
        TEST_ASSERT_TRUE(is_empty(interval_in_box(UNIT, vec3(-1, nextafter(1, 2), 0.5), vec3(1, 0, 0))));
    }
}

static void a_box_without_thickness_should_be_met(void)
{
    const Box flat = {{-1, -1, 0.3f}, {1, 1, 0.3f}};
    Interval inside = interval_in_box(flat, vec3(0.1, 0.2, 7), vec3(0.01, 0.02, -1.1));
    TEST_ASSERT_FALSE(is_empty(inside));
    TEST_ASSERT_DOUBLE_WITHIN(1e-14, (7 - (double)0.3f) / 1.1, inside.enter);
    TEST_ASSERT_FALSE(is_empty(interval_in_box(flat, vec3(-2, 0, (double)0.3f), vec3(1, 0, 0))));
}

static void one_sided_bounds_should_cut_a_ray_at_a_plane(void)
{
    Interval low = interval_between(-HUGE_VAL, 2, 0, 1), high = interval_between(2, HUGE_VAL, 0, 1);
    TEST_ASSERT_TRUE(low.enter == 0 && low.leave > 2 && high.enter < 2 && high.leave == HUGE_VAL);
    TEST_ASSERT_TRUE(is_empty(interval_between(-HUGE_VAL, 2, 3, 1)));
    TEST_ASSERT_FALSE(is_empty(interval_between(-HUGE_VAL, 2, 2, 0)));
    TEST_ASSERT_FALSE(is_empty(interval_between(2, HUGE_VAL, 2, 0)));
}

static void half_area_should_add_three_sides(void)
{
    TEST_ASSERT_TRUE(box_half_area((Box){{0, 0, 0}, {1, 2, 3}}) == 11);
    TEST_ASSERT_TRUE(box_half_area((Box){{0, 0, 5}, {1, 2, 5}}) == 2);
    TEST_ASSERT_TRUE(box_half_area(box_empty()) == 0);
    TEST_ASSERT_TRUE(box_half_area(box_union(box_empty(), UNIT)) == 3);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(interval_should_reach_a_little_beyond_the_exact_one);
    RUN_TEST(interval_should_not_depend_on_the_way_round);
    RUN_TEST(interval_should_begin_at_0_where_the_ray_starts_inside);
    RUN_TEST(interval_should_be_empty_behind_and_beside_the_ray);
    RUN_TEST(rays_in_a_side_of_the_box_should_be_inside);
    RUN_TEST(a_box_without_thickness_should_be_met);
    RUN_TEST(one_sided_bounds_should_cut_a_ray_at_a_plane);
    RUN_TEST(half_area_should_add_three_sides);
    return UNITY_END();
}
