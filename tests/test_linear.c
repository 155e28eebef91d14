/* Colours before they are clamped and become bytes: what RenderSettings.linear receives from either backend. */
#include "opencl/opencl.h"
#include "reader/scene_json.h"
#include "scene/light.h"
#include "trace/reference.h"
#include "trace/reference_render.h"

#include "unity.h"

#include <float.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Rich in everything; its colours exceed 1. Tall enough for several bands. */
enum { COLUMNS = 7, ROWS = 301, VALUES = COLUMNS * ROWS * 3 };

static Error error;
static Scene scene;
static double expected[VALUES], linear[VALUES];
static unsigned char bytes[VALUES];

static bool keep_band(void *user, int first_row, int rows, const unsigned char *rgb, const RenderReport *so_far,
                      Error *e)
{
    (void)user, (void)so_far, (void)e;
    memcpy(bytes + first_row * COLUMNS * 3, rgb, (size_t)(rows * COLUMNS * 3));
    return true;
}

void setUp(void)
{
    error = (Error){0};
    TEST_ASSERT_TRUE_MESSAGE(scene_load(&scene, "tests/scenes/many_lights.json", &error), error.text);
    scene.screen.columns = COLUMNS;
    scene.screen.rows = ROWS;
    scene.grid = 2;
    for (int i = 0; i < scene.light_count; i++)
        scene.lights[i].diffuse = vec3_scale(3, scene.lights[i].diffuse);
    RenderReport report = {0};
    for (int i = 0; i < COLUMNS * ROWS; i++) {
        Vec3 c = reference_pixel(&(Tracer){.scene = &scene, .report = &report}, i % COLUMNS, i / COLUMNS);
        memcpy(expected + 3 * i, (const double[]){c.x, c.y, c.z}, 3 * sizeof *expected);
    }
    for (int i = 0; i < VALUES; i++)
        linear[i] = -1;
    memset(bytes, 7, sizeof bytes);
}

void tearDown(void)
{
    scene_free(&scene);
}

static double largest(const double *values)
{
    double most = 0;
    for (int i = 0; i < VALUES; i++)
        most = fmax(most, values[i]);
    return most;
}

/* The bytes that come along are those of the colours. */
static void check_bytes(void)
{
    for (int i = 0; i < VALUES; i++)
        TEST_ASSERT_EQUAL_INT(colour_to_byte(linear[i]), bytes[i]);
}

static void reference_should_hand_out_its_own_colours(void)
{
    RenderReport report;
    RenderSettings settings = {.linear = linear};
    TEST_ASSERT_TRUE(reference_render(&scene, &settings, (BandSink){keep_band, NULL}, &report, &error));
    TEST_ASSERT_EQUAL_MEMORY(expected, linear, sizeof linear);
    TEST_ASSERT_TRUE_MESSAGE(largest(linear) > 1, "no colour of this scene would be clamped");
    check_bytes();
}

static int by_size(const void *a, const void *b)
{
    double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

/* The difference that a share of 0.1 % of the values exceeds; the float kernel may decide an edge otherwise. */
static double almost_largest_difference(void)
{
    static double differences[VALUES];
    for (int i = 0; i < VALUES; i++)
        differences[i] = fabs(linear[i] - expected[i]) / fmax(1, expected[i]);
    qsort(differences, VALUES, sizeof *differences, by_size);
    return differences[VALUES - 1 - VALUES / 1000];
}

static void kernel_should_give_the_colours_of_the_reference(void)
{
    const int lanes[] = {1, 4, 8, 16};
    for (int k = 0; k < 4; k++) {
        RenderReport report;
        RenderSettings settings = {.linear = linear, .device = -1, .lanes = lanes[k], .precision = PRECISION_DOUBLE};
        TEST_ASSERT_TRUE_MESSAGE(opencl_render(&scene, &settings, (BandSink){keep_band, NULL}, &report, &error),
                                 error.text);
        check_bytes();
        for (int i = 0; i < VALUES;
             i++) /* a power of OpenCL may be off by 16 ulp, of a sum of up to 8 terms by lights and bounces */
            TEST_ASSERT_DOUBLE_WITHIN(1e-13 * fmax(1, expected[i]), expected[i], linear[i]);
        settings.precision = PRECISION_FLOAT;
        TEST_ASSERT_TRUE_MESSAGE(opencl_render(&scene, &settings, (BandSink){keep_band, NULL}, &report, &error),
                                 error.text);
        check_bytes();
        TEST_ASSERT_DOUBLE_WITHIN(1e-4, 0, almost_largest_difference());
        TEST_ASSERT_TRUE(largest(linear) > 1);
    }
}

static void ordinary_pictures_should_be_built_without_them(void)
{
    RenderReport report;
    RenderSettings settings = {.device = -1};
    TEST_ASSERT_TRUE_MESSAGE(opencl_render(&scene, &settings, (BandSink){keep_band, NULL}, &report, &error),
                             error.text);
    TEST_ASSERT_NULL(strstr(report.build_options, "LINEAR"));
    settings.linear = linear;
    TEST_ASSERT_TRUE_MESSAGE(opencl_render(&scene, &settings, (BandSink){keep_band, NULL}, &report, &error),
                             error.text);
    TEST_ASSERT_NOT_NULL(strstr(report.build_options, "-DLINEAR"));
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(reference_should_hand_out_its_own_colours);
    RUN_TEST(kernel_should_give_the_colours_of_the_reference);
    RUN_TEST(ordinary_pictures_should_be_built_without_them);
    return UNITY_END();
}
