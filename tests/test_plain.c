/* The plain kernel in exact arithmetic against the reference, on every scene in scenes/, scenes/lessons/ and
 * tests/scenes/: in double the same bytes and the same counts; in float off by more than 1/255 as seldom as the packet
 * kernel, and only beside edges. A new scene file is tested without a word here. */
#include "opencl/opencl.h"
#include "trace/reference_render.h"

#include "support/near_edge.h"
#include "support/plain_picture.h"

#include "unity.h"

#include <stdlib.h>
#include <string.h>

static const AccelKind ACCELS[] = {ACCEL_NONE, ACCEL_KDTREE, ACCEL_BVH};
enum { ACCEL_KINDS = sizeof ACCELS / sizeof ACCELS[0] };

static Error error;

void setUp(void)
{
    error = (Error){0};
}
void tearDown(void) {}

static void compare_double(const char *path, const Scene *scene)
{
    Picture expected = picture_render(scene, BACKEND_REFERENCE, (RenderSettings){.accel = ACCEL_NONE});
    for (int k = 0; k < ACCEL_KINDS; k++) {
        RenderSettings settings = plain_settings(PRECISION_DOUBLE, ACCELS[k], ARITHMETIC_EXACT);
        Picture picture = picture_render(scene, BACKEND_OPENCL, settings);
        assert_same_picture(path, &expected, &picture, &settings);
        free(picture.rgb);
    }
    free(expected.rgb);
}

static void plain_double_should_equal_the_reference_on_every_scene(void)
{
    for_each_scene(compare_double);
}

static void tall_pictures_should_be_whole(void)
{
    Scene scene = load_small(RICH_SCENE);
    scene.screen.columns = 3;
    scene.screen.rows = 700; /* several bands */
    compare_double(RICH_SCENE, &scene);
    scene_free(&scene);
}

static void compare_float(const char *path, const Scene *scene)
{
    RenderSettings settings = plain_settings(PRECISION_FLOAT, ACCEL_AUTO, ARITHMETIC_EXACT);
    Picture expected = picture_render(scene, BACKEND_REFERENCE, (RenderSettings){.accel = ACCEL_AUTO});
    Picture picture = picture_render(scene, BACKEND_OPENCL, settings);
    int pixels = expected.columns * expected.rows, allowed = pixels < 10000 ? 1 : pixels / 10000, off = 0;
    for (int i = 0; i < pixels; i++)
        if (pixel_difference(&expected, &picture, i) > 1) {
            bool near_edge = is_near_edge(scene, i % expected.columns, i / expected.columns);
            TEST_ASSERT_TRUE_MESSAGE(near_edge, picture_describe(path, &expected, &settings, i));
            TEST_ASSERT_LESS_OR_EQUAL_MESSAGE(allowed, ++off, picture_describe(path, &expected, &settings, i));
        }
    free(expected.rgb);
    free(picture.rgb);
}

static void plain_float_should_be_close_to_the_reference_on_every_scene(void)
{
    for_each_scene(compare_float);
}

static void plain_kernel_should_give_colours_before_they_are_bytes(void)
{
    Scene scene = load_small(RICH_SCENE);
    scene.grid = 2;
    size_t values = (size_t)scene.screen.columns * (size_t)scene.screen.rows * 3;
    double *expected = calloc(values, sizeof *expected), *found = calloc(values, sizeof *found);
    Picture reference = picture_render(&scene, BACKEND_REFERENCE, (RenderSettings){.linear = expected});
    RenderSettings settings = plain_settings(PRECISION_DOUBLE, ACCEL_AUTO, ARITHMETIC_EXACT);
    settings.linear = found;
    Picture picture = picture_render(&scene, BACKEND_OPENCL, settings);
    assert_same_picture(RICH_SCENE, &reference, &picture, &settings);
    for (size_t i = 0; i < values; i++)
        TEST_ASSERT_DOUBLE_WITHIN(1e-12, expected[i], found[i]);
    free(reference.rgb);
    free(picture.rgb);
    free(expected);
    free(found);
    scene_free(&scene);
}

/* --- What there is not --- */

static void assert_refused(const Scene *scene, Backend backend, RenderSettings settings, const char *way_out)
{
    RenderReport report;
    BandSink sink = {picture_take_band, NULL};
    settings.device = -1;
    error = (Error){0};
    TEST_ASSERT_FALSE(backend == BACKEND_OPENCL ? opencl_render(scene, &settings, sink, &report, &error)
                                                : reference_render(scene, &settings, sink, &report, &error));
    TEST_ASSERT_EQUAL_INT(ERROR_USAGE, error.kind);
    TEST_ASSERT_NOT_NULL_MESSAGE(strstr(error.text, way_out), error.text);
}

static void what_is_not_there_should_be_refused_with_the_way_out(void)
{
    Scene scene = load_small(RICH_SCENE);
    RenderSettings exact = plain_settings(PRECISION_FLOAT, ACCEL_AUTO, ARITHMETIC_EXACT), textbook = exact;
    textbook.arithmetic = ARITHMETIC_TEXTBOOK;
    RenderSettings lanes = exact, packet = textbook, tree = textbook;
    lanes.lanes = 4;
    packet.kernel = KERNEL_PACKET;
    tree.accel = ACCEL_BVH;
    assert_refused(&scene, BACKEND_OPENCL, lanes, "--kernel packet");
    assert_refused(&scene, BACKEND_OPENCL, packet, "--kernel plain");
    assert_refused(&scene, BACKEND_REFERENCE, tree, "leave out --accel");
    scene.adaptive = true;
    scene.grid = 2;
    assert_refused(&scene, BACKEND_OPENCL, exact, "--sampling uniform:N or --kernel packet");
    assert_refused(&scene, BACKEND_REFERENCE, textbook, "--sampling uniform:N");
    scene_free(&scene);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(plain_double_should_equal_the_reference_on_every_scene);
    RUN_TEST(tall_pictures_should_be_whole);
    RUN_TEST(plain_float_should_be_close_to_the_reference_on_every_scene);
    RUN_TEST(plain_kernel_should_give_colours_before_they_are_bytes);
    RUN_TEST(what_is_not_there_should_be_refused_with_the_way_out);
    return UNITY_END();
}
