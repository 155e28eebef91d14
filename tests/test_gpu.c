/* The kernel for GPUs against the reference, on every scene in scenes/, scenes/lessons/ and tests/scenes/, with each
 * kind of tree: no pixel is off by more than 1/255 but beside edges, and no more of them than the packet kernel may
 * have. A path that float is sure of is the reference's path, so that the rays are equal in number. Any OpenCL device
 * runs this kernel. A new scene file is tested without a word here. */
#include "opencl/opencl.h"
#include "reader/scene_json.h"
#include "trace/reference_render.h"

#include "support/near_edge.h"
#include "support/plain_picture.h"

#include "unity.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const AccelKind ACCELS[] = {ACCEL_NONE, ACCEL_KDTREE, ACCEL_BVH};
enum { ACCEL_KINDS = sizeof ACCELS / sizeof ACCELS[0] };

void setUp(void) {}
void tearDown(void) {}

/* All work is done that might be left out, so that the counts are the reference's. */
static RenderSettings gpu_settings(AccelKind accel)
{
    return (RenderSettings){.kernel = KERNEL_GPU, .accel = accel, .no_skip = ~0u};
}

static void assert_close(const char *path, const Scene *scene, const Picture *expected, const Picture *picture,
                         const RenderSettings *settings)
{
    int pixels = expected->columns * expected->rows, allowed = pixels < 10000 ? 1 : pixels / 10000, off = 0;
    for (int i = 0; i < pixels; i++)
        if (pixel_difference(expected, picture, i) > 1) {
            const char *place = picture_describe(path, expected, settings, i);
            TEST_ASSERT_TRUE_MESSAGE(is_near_edge(scene, i % expected->columns, i / expected->columns), place);
            TEST_ASSERT_LESS_OR_EQUAL_MESSAGE(allowed, ++off, place);
        }
}

static void assert_same_rays(const char *path, const Picture *expected, const Picture *picture)
{
    const RenderReport *a = &expected->report, *b = &picture->report;
    TEST_ASSERT_EQUAL_UINT64_MESSAGE(a->rays.primary, b->rays.primary, path);
    TEST_ASSERT_EQUAL_UINT64_MESSAGE(a->rays.shadow, b->rays.shadow, path);
    TEST_ASSERT_EQUAL_UINT64_MESSAGE(a->rays.reflection, b->rays.reflection, path);
    TEST_ASSERT_EQUAL_UINT64_MESSAGE(a->skipped[SKIP_LIGHT_BEHIND], b->skipped[SKIP_LIGHT_BEHIND], path);
    TEST_ASSERT_EQUAL_INT_MESSAGE(KERNEL_GPU, b->kernel, path);
}

static void compare(const char *path, const Scene *scene)
{
    Picture expected = picture_render(scene, BACKEND_REFERENCE, (RenderSettings){.accel = ACCEL_NONE});
    for (int k = 0; k < ACCEL_KINDS; k++) {
        RenderSettings settings = gpu_settings(ACCELS[k]);
        Picture picture = picture_render(scene, BACKEND_OPENCL, settings);
        assert_close(path, scene, &expected, &picture, &settings);
        assert_same_rays(path, &expected, &picture);
        free(picture.rgb);
    }
    free(expected.rgb);
}

static void every_scene_should_be_close_to_the_reference(void)
{
    for_each_scene(compare);
}

static void pictures_of_several_bands_and_odd_sizes_should_be_whole(void)
{
    Scene scene = load_small(RICH_SCENE);
    scene.screen.columns = 3;
    scene.screen.rows = 700;
    scene.grid = 3;
    compare(RICH_SCENE, &scene);
    scene.screen.columns = 701;
    scene.screen.rows = 3;
    scene.grid = 9; /* more samples than shares */
    RenderSettings settings = gpu_settings(ACCEL_BVH);
    Picture expected = picture_render(&scene, BACKEND_REFERENCE, (RenderSettings){.accel = ACCEL_NONE});
    Picture picture = picture_render(&scene, BACKEND_OPENCL, settings);
    assert_close(RICH_SCENE, &scene, &expected, &picture, &settings);
    assert_same_rays(RICH_SCENE, &expected, &picture);
    free(expected.rgb);
    free(picture.rgb);
    scene_free(&scene);
}

/* --- The exact pass --- */

/* Two equal quads in one place fill the picture: which one a ray meets is a matter of their order in the file. */
static const char TWO_IN_ONE_PLACE[] =
    "{\"camera\": {\"position\": [0, 0, 1], \"look_at\": [0, 0, 0]}, \"screen\": {\"columns\": 40, \"rows\": 30},"
    "\"lights\": [{\"position\": [1, 2, 3]}],"
    "\"materials\": {\"red\": {\"diffuse\": [1, 0, 0]}, \"blue\": {\"diffuse\": [0, 0, 1]}}, \"objects\": ["
    "{\"material\": \"red\", \"vertices\": [[-9, -9, 0], [9, -9, 0], [9, 9, 0], [-9, 9, 0]], \"faces\": [[0, 1, 2, "
    "3]]},"
    "{\"material\": \"blue\", \"vertices\": [[-9, -9, 0], [9, -9, 0], [9, 9, 0], [-9, 9, 0]], \"faces\": [[0, 1, 2, "
    "3]]}"
    "]}";

static void a_list_that_is_full_should_lose_no_ray(void)
{
    Scene scene;
    Error error = {0};
    long length = (long)strlen(TWO_IN_ONE_PLACE);
    TEST_ASSERT_TRUE_MESSAGE(scene_parse(&scene, "two.json", TWO_IN_ONE_PLACE, length, &error), error.text);
    scene.adaptive = false;
    scene.grid = 1;
    Picture expected = picture_render(&scene, BACKEND_REFERENCE, (RenderSettings){.accel = ACCEL_NONE});
    Picture picture = picture_render(&scene, BACKEND_OPENCL, gpu_settings(ACCEL_NONE));
    TEST_ASSERT_EQUAL_UINT64(40 * 30, picture.report.exact_pixels);
    for (int i = 0; i < 40 * 30; i++)
        TEST_ASSERT_LESS_OR_EQUAL_INT(1, pixel_difference(&expected, &picture, i));
    assert_same_rays("a full list", &expected, &picture);
    free(expected.rgb);
    free(picture.rgb);
    scene_free(&scene);
}

/* The ray of each pixel goes exactly through the edge between two strips. It meets both, and the first in the file
 * counts. Rounded, it may go past the edge on either side. */
static void rays_through_edges_should_be_decided_exactly(void)
{
    enum { COLUMNS = 32, ROWS = 24 };
    static char text[8192];
    int used = snprintf(text, sizeof text,
                        "{\"camera\": {\"position\": [0, 0, 2], \"look_at\": [0, 0, 0]},"
                        "\"screen\": {\"columns\": %d, \"rows\": %d, \"width\": 2, \"distance\": 1},"
                        "\"lights\": [{\"position\": [1, 2, 3]}], \"materials\": {\"0\": {\"diffuse\": [1, 0, 0]},"
                        "\"1\": {\"diffuse\": [0, 0, 1]}}, \"objects\": [",
                        COLUMNS, ROWS);
    for (int i = 0; i <= COLUMNS; i++) { /* on the plane z = 0, the middles of columns are 1/8 apart */
        double left = (2 * i - 1 - COLUMNS) / 16.0, right = left + 0.125;
        used += snprintf(text + used, sizeof text - (size_t)used,
                         "%s{\"material\": \"%d\", \"faces\": [[0, 1, 2, 3]],"
                         "\"vertices\": [[%g, -3, 0], [%g, -3, 0], [%g, 3, 0], [%g, 3, 0]]}",
                         i > 0 ? "," : "", i % 2, left, right, right, left);
    }
    used += snprintf(text + used, sizeof text - (size_t)used, "]}");
    Scene scene;
    Error error = {0};
    TEST_ASSERT_TRUE_MESSAGE(scene_parse(&scene, "strips.json", text, used, &error), error.text);
    scene.adaptive = false;
    scene.grid = 1;
    Picture expected = picture_render(&scene, BACKEND_REFERENCE, (RenderSettings){.accel = ACCEL_NONE});
    Picture picture = picture_render(&scene, BACKEND_OPENCL, gpu_settings(ACCEL_BVH));
    TEST_ASSERT_EQUAL_UINT64(COLUMNS * ROWS, picture.report.exact_pixels);
    for (int i = 0; i < COLUMNS * ROWS; i++)
        TEST_ASSERT_LESS_OR_EQUAL_INT(1, pixel_difference(&expected, &picture, i));
    free(expected.rgb);
    free(picture.rgb);
    scene_free(&scene);
}

static void few_pixels_should_be_in_doubt(void)
{
    const char *const paths[] = {"scenes/original.json", "scenes/cornell.json", "scenes/gallery.json"};
    for (size_t i = 0; i < sizeof paths / sizeof *paths; i++) {
        Scene scene = load_small(paths[i]);
        scene.screen.columns = 160;
        scene.screen.rows = 90;
        Picture picture = picture_render(&scene, BACKEND_OPENCL, gpu_settings(ACCEL_BVH));
        TEST_ASSERT_LESS_THAN_UINT64_MESSAGE(160 * 90 / 50, picture.report.exact_pixels, paths[i]);
        free(picture.rgb);
        scene_free(&scene);
    }
}

static void linear_colours_should_be_those_of_the_reference(void)
{
    Scene scene = load_small(RICH_SCENE);
    scene.grid = 2;
    size_t values = (size_t)scene.screen.columns * (size_t)scene.screen.rows * 3;
    double *expected = calloc(values, sizeof *expected), *found = calloc(values, sizeof *found);
    Picture reference = picture_render(&scene, BACKEND_REFERENCE, (RenderSettings){.linear = expected});
    RenderSettings settings = gpu_settings(ACCEL_AUTO);
    settings.linear = found;
    Picture picture = picture_render(&scene, BACKEND_OPENCL, settings);
    for (size_t i = 0; i < values; i++)
        TEST_ASSERT_DOUBLE_WITHIN(1e-3 * (1 + fabs(expected[i])), expected[i], found[i]);
    free(reference.rgb);
    free(picture.rgb);
    free(expected);
    free(found);
    scene_free(&scene);
}

/* --- What there is not --- */

static void assert_refused(const Scene *scene, RenderSettings settings, const char *way_out)
{
    RenderReport report;
    Error error = {0};
    BandSink sink = {picture_take_band, NULL};
    settings.device = -1;
    TEST_ASSERT_FALSE(opencl_render(scene, &settings, sink, &report, &error));
    TEST_ASSERT_EQUAL_INT(ERROR_USAGE, error.kind);
    TEST_ASSERT_NOT_NULL_MESSAGE(strstr(error.text, way_out), error.text);
}

static void what_is_not_there_should_be_refused_with_the_way_out(void)
{
    Scene scene = load_small(RICH_SCENE);
    RenderSettings lanes = gpu_settings(ACCEL_AUTO), textbook = lanes, in_double = lanes;
    lanes.lanes = 4;
    textbook.arithmetic = ARITHMETIC_TEXTBOOK;
    in_double.precision = PRECISION_DOUBLE;
    assert_refused(&scene, lanes, "--kernel packet");
    assert_refused(&scene, textbook, "--kernel plain");
    assert_refused(&scene, in_double, "leave out --precision");
    scene_free(&scene);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(every_scene_should_be_close_to_the_reference);
    RUN_TEST(pictures_of_several_bands_and_odd_sizes_should_be_whole);
    RUN_TEST(a_list_that_is_full_should_lose_no_ray);
    RUN_TEST(rays_through_edges_should_be_decided_exactly);
    RUN_TEST(few_pixels_should_be_in_doubt);
    RUN_TEST(linear_colours_should_be_those_of_the_reference);
    RUN_TEST(what_is_not_there_should_be_refused_with_the_way_out);
    return UNITY_END();
}
