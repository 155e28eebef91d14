/* Blinn-Phong, term by term, on vectors whose angles have closed-form cosines; and the last step to 8 bits. */
#include "scene/light.h"

#include "support/assert_vec3.h"

#include "unity.h"

#define EXACT 1e-15

static const Vec3 N = {0, 0, 1};
static Material material;
static Light light;

void setUp(void)
{
    material =
        (Material){.ambient = {0.1, 0.2, 0.3}, .diffuse = {0.4, 0.5, 0.6}, .specular = {0.7, 0.8, 0.9}, .shininess = 8};
    light = (Light){.ambient = {1, 2, 4}, .diffuse = {2, 4, 8}, .specular = {4, 8, 16}};
}

void tearDown(void) {}

/* The unit vector in the x-z plane, `degrees` from N. */
static Vec3 tilted(double degrees)
{
    double radians = degrees * acos(-1) / 180;
    return vec3(sin(radians), 0, cos(radians));
}

static void ambient_should_multiply_colour_by_colour(void)
{
    Illumination i = illuminate(&material, &light, N, tilted(70), tilted(-20));
    ASSERT_VEC3_WITHIN(EXACT, 0.1, 0.4, 1.2, i.ambient);
}

static void ambient_should_not_depend_on_any_direction(void)
{
    Illumination i = illuminate(&material, &light, N, tilted(180), tilted(120));
    ASSERT_VEC3_WITHIN(EXACT, 0.1, 0.4, 1.2, i.ambient);
}

static void diffuse_should_follow_the_cosine_of_the_light(void)
{
    Illumination i = illuminate(&material, &light, N, tilted(60), N);
    TEST_ASSERT_DOUBLE_WITHIN(EXACT, 0.5, i.l_dot_n);
    ASSERT_VEC3_WITHIN(4 * EXACT, 0.4, 1, 2.4, i.diffuse);
    i = illuminate(&material, &light, N, N, N);
    ASSERT_VEC3_WITHIN(4 * EXACT, 0.8, 2, 4.8, i.diffuse);
}

static void diffuse_should_not_depend_on_the_viewer(void)
{
    Illumination a = illuminate(&material, &light, N, tilted(60), tilted(10));
    Illumination b = illuminate(&material, &light, N, tilted(60), tilted(-80));
    TEST_ASSERT_EQUAL_MEMORY(&a.diffuse, &b.diffuse, sizeof a.diffuse);
}

static void diffuse_should_clamp_a_light_behind_the_surface_to_zero(void)
{
    Illumination i = illuminate(&material, &light, N, tilted(120), N);
    TEST_ASSERT_TRUE(i.l_dot_n == 0);
    ASSERT_VEC3_WITHIN(0, 0, 0, 0, i.diffuse);
}

static void halfway_should_bisect_light_and_viewer(void)
{
    Illumination i = illuminate(&material, &light, N, tilted(80), tilted(20));
    ASSERT_VEC3_WITHIN(EXACT, tilted(50).x, 0, tilted(50).z, i.h);
    i = illuminate(&material, &light, N, tilted(40), tilted(-40));
    ASSERT_VEC3_WITHIN(EXACT, 0, 0, 1, i.h);
    TEST_ASSERT_DOUBLE_WITHIN(EXACT, 1, i.n_dot_h);
}

static void specular_should_raise_the_cosine_to_a_quarter_of_alpha(void)
{
    const struct {
        double shininess, highlight; /* (1/2)^(alpha/4) */
    } cases[] = {{0, 1}, {2, 0.70710678118654752}, {4, 0.5}, {8, 0.25}, {40, 0x1p-10}};
    for (int k = 0; k < 5; k++) {
        material.shininess = cases[k].shininess;
        Illumination i = illuminate(&material, &light, N, tilted(60), tilted(60)); /* H = L = V */
        double h = cases[k].highlight;
        ASSERT_VEC3_WITHIN(1e-13, 2.8 * h, 6.4 * h, 14.4 * h, i.specular);
    }
}

static void specular_should_be_full_in_the_mirror_direction(void)
{
    material.shininess = 1e6;
    Illumination i = illuminate(&material, &light, N, N, N);
    ASSERT_VEC3_WITHIN(1e-13, 2.8, 6.4, 14.4, i.specular);
}

static void specular_should_clamp_a_halfway_behind_the_surface_to_zero(void)
{
    Illumination i = illuminate(&material, &light, N, tilted(120), tilted(100));
    TEST_ASSERT_TRUE(i.n_dot_h == 0);
    ASSERT_VEC3_WITHIN(0, 0, 0, 0, i.specular);
}

static void opposite_light_and_viewer_should_give_no_highlight(void)
{
    Illumination i = illuminate(&material, &light, N, vec3(1, 0, 0), vec3(-1, 0, 0));
    ASSERT_VEC3_WITHIN(0, 0, 0, 0, i.h);
    ASSERT_VEC3_WITHIN(0, 0, 0, 0, i.specular);
}

/* 0^0 = 1: with alpha 0 the highlight is everywhere, as the formula says. */
static void shininess_of_zero_should_light_everything(void)
{
    material.shininess = 0;
    Illumination i = illuminate(&material, &light, N, tilted(120), tilted(100));
    ASSERT_VEC3_WITHIN(1e-13, 2.8, 6.4, 14.4, i.specular);
}

static void byte_should_round_to_the_nearest(void)
{
    for (int byte = 0; byte <= 255; byte++)
        TEST_ASSERT_EQUAL_UINT8(byte, colour_to_byte(byte / 255.0));
    TEST_ASSERT_EQUAL_UINT8(128, colour_to_byte(0.5)); /* 127.5 goes up */
    TEST_ASSERT_EQUAL_UINT8(127, colour_to_byte(0.49999));
    TEST_ASSERT_EQUAL_UINT8(0, colour_to_byte(0.00196));
    TEST_ASSERT_EQUAL_UINT8(1, colour_to_byte(0.00197));
}

static void byte_should_clamp_to_its_range(void)
{
    TEST_ASSERT_EQUAL_UINT8(0, colour_to_byte(-1e300));
    TEST_ASSERT_EQUAL_UINT8(0, colour_to_byte(-0.1));
    TEST_ASSERT_EQUAL_UINT8(255, colour_to_byte(1.0000001));
    TEST_ASSERT_EQUAL_UINT8(255, colour_to_byte(1e300));
    TEST_ASSERT_EQUAL_UINT8(255, colour_to_byte(HUGE_VAL));
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(ambient_should_multiply_colour_by_colour);
    RUN_TEST(ambient_should_not_depend_on_any_direction);
    RUN_TEST(diffuse_should_follow_the_cosine_of_the_light);
    RUN_TEST(diffuse_should_not_depend_on_the_viewer);
    RUN_TEST(diffuse_should_clamp_a_light_behind_the_surface_to_zero);
    RUN_TEST(halfway_should_bisect_light_and_viewer);
    RUN_TEST(specular_should_raise_the_cosine_to_a_quarter_of_alpha);
    RUN_TEST(specular_should_be_full_in_the_mirror_direction);
    RUN_TEST(specular_should_clamp_a_halfway_behind_the_surface_to_zero);
    RUN_TEST(opposite_light_and_viewer_should_give_no_highlight);
    RUN_TEST(shininess_of_zero_should_light_everything);
    RUN_TEST(byte_should_round_to_the_nearest);
    RUN_TEST(byte_should_clamp_to_its_range);
    return UNITY_END();
}
