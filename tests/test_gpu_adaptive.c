/* Adaptive sampling by the kernels for GPUs against the packet kernel with one lane, on every scene in scenes/,
 * scenes/lessons/ and tests/scenes/: the same pixels are refined, the same rays traced, and no pixel is off by more
 * than 1/255. The packet kernel is held against the reference by test_adaptive.c. A new scene file is tested without a
 * word here. */
#include "opencl/opencl.h"
#include "reader/scene_json.h"

#include "support/plain_picture.h"

#include "unity.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

void setUp(void) {}
void tearDown(void) {}

/* The packet kernel does all work that might be left out, but for shadow rays to lights behind a face: the kernels for
 * GPUs do not cast them. */
static RenderSettings settings_of(KernelKind kernel, AccelKind accel)
{
    return (RenderSettings){.kernel = kernel,
                            .lanes = kernel == KERNEL_PACKET ? 1 : 0,
                            .accel = accel,
                            .no_skip = ~(1u << SKIP_LIGHT_BEHIND)};
}

static void assert_same_counts(const char *path, const RenderReport *a, const RenderReport *b)
{
    TEST_ASSERT_EQUAL_UINT64_MESSAGE(a->refined_pixels, b->refined_pixels, path);
    TEST_ASSERT_EQUAL_UINT64_MESSAGE(a->rays.primary, b->rays.primary, path);
    TEST_ASSERT_EQUAL_UINT64_MESSAGE(a->rays.shadow, b->rays.shadow, path);
    TEST_ASSERT_EQUAL_UINT64_MESSAGE(a->rays.reflection, b->rays.reflection, path);
    TEST_ASSERT_EQUAL_UINT64_MESSAGE(a->skipped[SKIP_LIGHT_BEHIND], b->skipped[SKIP_LIGHT_BEHIND], path);
    TEST_ASSERT_EQUAL_INT_MESSAGE(KERNEL_GPU, b->kernel, path);
}

/* Returns how many pixels were refined. */
static uint64_t compare_with(const char *path, const Scene *scene, AccelKind accel)
{
    static char message[512];
    Picture expected = picture_render(scene, BACKEND_OPENCL, settings_of(KERNEL_PACKET, accel));
    Picture picture = picture_render(scene, BACKEND_OPENCL, settings_of(KERNEL_GPU, accel));
    for (int i = 0; i < expected.columns * expected.rows; i++)
        if (pixel_difference(&expected, &picture, i) > 1) {
            snprintf(message, sizeof message,
                     "pixel %d,%d; see: rectray render %s --sampling adaptive:%d --size %dx%d --kernel gpu --accel %s",
                     i % expected.columns, i / expected.columns, path, scene->grid, expected.columns, expected.rows,
                     render_accels[accel]);
            TEST_FAIL_MESSAGE(message);
        }
    assert_same_counts(path, &expected.report, &picture.report);
    free(expected.rgb);
    free(picture.rgb);
    return picture.report.refined_pixels;
}

static uint64_t refined;
static int accel_of_next;

/* Each scene with one kind of tree, in turn. */
static void compare(const char *path, const Scene *small)
{
    const AccelKind accels[] = {ACCEL_BVH, ACCEL_KDTREE, ACCEL_NONE};
    Scene scene = *small;
    scene.adaptive = true;
    scene.grid = 4;
    refined += compare_with(path, &scene, accels[accel_of_next++ % 3]);
}

static void every_scene_should_be_that_of_the_packet_kernel(void)
{
    refined = 0;
    for_each_scene(compare);
    TEST_ASSERT_GREATER_THAN_UINT64(1000, refined);
}

static Scene adaptive_scene(const char *path, int columns, int rows, int grid)
{
    Scene scene = load_small(path);
    scene.screen.columns = columns;
    scene.screen.rows = rows;
    scene.adaptive = true;
    scene.grid = grid;
    return scene;
}

static void every_tree_should_decide_alike(void)
{
    Scene scene = adaptive_scene("scenes/gallery.json", 96, 54, 4);
    uint64_t with_bvh = compare_with("scenes/gallery.json", &scene, ACCEL_BVH);
    TEST_ASSERT_EQUAL_UINT64(with_bvh, compare_with("scenes/gallery.json", &scene, ACCEL_KDTREE));
    TEST_ASSERT_EQUAL_UINT64(with_bvh, compare_with("scenes/gallery.json", &scene, ACCEL_NONE));
    scene_free(&scene);
}

static void pictures_of_several_bands_and_odd_sizes_should_be_whole(void)
{
    const struct {
        int columns, rows, grid;
    } sizes[] = {{3, 700, 2}, {701, 3, 2}, {101, 203, 24}}; /* the last is 3 bands */
    for (size_t i = 0; i < sizeof sizes / sizeof *sizes; i++) {
        Scene scene = adaptive_scene(RICH_SCENE, sizes[i].columns, sizes[i].rows, sizes[i].grid);
        TEST_ASSERT_GREATER_THAN_UINT64(0, compare_with(RICH_SCENE, &scene, ACCEL_BVH));
        scene_free(&scene);
    }
}

static void more_samples_than_shares_of_doubt_should_be_counted(void)
{
    Scene scene = adaptive_scene(RICH_SCENE, 31, 23, 24); /* 256 samples */
    uint64_t pixels = compare_with(RICH_SCENE, &scene, ACCEL_BVH);
    Picture picture = picture_render(&scene, BACKEND_OPENCL, settings_of(KERNEL_GPU, ACCEL_BVH));
    TEST_ASSERT_EQUAL_UINT64(31 * 23 + 256 * pixels, picture.report.rays.primary);
    free(picture.rgb);
    scene_free(&scene);
}

static void the_longest_trails_should_be_kept(void)
{
    Scene scene = adaptive_scene("scenes/mirrors.json", 64, 48, 4);
    scene.shading.max_bounces = SCENE_MAX_BOUNCES;
    compare_with("scenes/mirrors.json", &scene, ACCEL_NONE);
    scene_free(&scene);
}

/* --- The exact passes --- */

/* Two equal quads in one place: which one a ray meets is a matter of their order in the file. A mirror stands across,
 * so that the path has a second hit. */
static const char TWO_IN_ONE_PLACE[] =
    "{\"camera\": {\"position\": [0, 0, 1], \"look_at\": [0, 0, 0]}, \"screen\": {\"columns\": 40, \"rows\": 30},"
    "\"lights\": [{\"position\": [0.5, 0.25, 2]}], \"shading\": {\"max_bounces\": 2},"
    "\"materials\": {\"mirror\": {\"diffuse\": [0.5, 0, 0], \"reflection\": 0.5}, \"blue\": {\"diffuse\": [0, 0, 1]}},"
    "\"objects\": ["
    "{\"material\": \"mirror\", \"vertices\": [[-9, -9, 0], [9, -9, 0], [9, 9, 0], [-9, 9, 0]], \"faces\": [[0, 1, 2, "
    "3]]},"
    "{\"material\": \"blue\", \"vertices\": [[-9, -9, 0], [9, -9, 0], [9, 9, 0], [-9, 9, 0]], \"faces\": [[0, 1, 2, "
    "3]]},"
    "{\"material\": \"blue\", \"vertices\": [[-9, -9, 3], [0, -9, 3], [0, 9, 3], [-9, 9, 3]], \"faces\": [[0, 1, 2, "
    "3]]}"
    "]}";

static void centres_in_doubt_should_be_judged_by_their_exact_path(void)
{
    Scene scene;
    Error error = {0};
    long length = (long)strlen(TWO_IN_ONE_PLACE);
    TEST_ASSERT_TRUE_MESSAGE(scene_parse(&scene, "two.json", TWO_IN_ONE_PLACE, length, &error), error.text);
    scene.adaptive = true;
    scene.grid = 4;
    uint64_t pixels = compare_with("two.json", &scene, ACCEL_NONE);
    TEST_ASSERT_GREATER_THAN_UINT64(0, pixels);
    Picture picture = picture_render(&scene, BACKEND_OPENCL, settings_of(KERNEL_GPU, ACCEL_NONE));
    TEST_ASSERT_EQUAL_UINT64(40 * 30 + pixels, picture.report.exact_pixels);
    free(picture.rgb);
    scene_free(&scene);
}

static void linear_colours_should_be_those_of_the_packet_kernel(void)
{
    Scene scene = adaptive_scene(RICH_SCENE, 61, 47, 4);
    size_t values = (size_t)scene.screen.columns * (size_t)scene.screen.rows * 3;
    double *expected = calloc(values, sizeof *expected), *found = calloc(values, sizeof *found);
    RenderSettings packet = settings_of(KERNEL_PACKET, ACCEL_BVH), gpu = settings_of(KERNEL_GPU, ACCEL_BVH);
    packet.linear = expected;
    gpu.linear = found;
    free(picture_render(&scene, BACKEND_OPENCL, packet).rgb);
    free(picture_render(&scene, BACKEND_OPENCL, gpu).rgb);
    for (size_t i = 0; i < values; i++)
        TEST_ASSERT_DOUBLE_WITHIN(1e-3 * (1 + fabs(expected[i])), expected[i], found[i]);
    free(expected);
    free(found);
    scene_free(&scene);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(every_scene_should_be_that_of_the_packet_kernel);
    RUN_TEST(every_tree_should_decide_alike);
    RUN_TEST(pictures_of_several_bands_and_odd_sizes_should_be_whole);
    RUN_TEST(more_samples_than_shares_of_doubt_should_be_counted);
    RUN_TEST(the_longest_trails_should_be_kept);
    RUN_TEST(centres_in_doubt_should_be_judged_by_their_exact_path);
    RUN_TEST(linear_colours_should_be_those_of_the_packet_kernel);
    return UNITY_END();
}
