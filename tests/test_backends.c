/* The reference against the OpenCL kernels, two tracers that share no code, on every scene in scenes/ and
 * tests/scenes/. The double kernel must give the reference's bytes. The float kernel may be off by more than 1/255 in
 * 0.01 % of the pixels, in one pixel of a picture too small for that share to allow any, and only where the 3 x 3
 * pixels around show an edge: of a face, of a shadow, or of either in a mirror. A new scene file is tested without a
 * word here. */
#include "opencl/opencl.h"
#include "reader/scene_json.h"
#include "trace/reference_render.h"

#include "support/near_edge.h"

#include "unity.h"

#include <glob.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const int LANES[] = {1, 4, 8, 16};
enum { LANE_KINDS = sizeof LANES / sizeof LANES[0] };

/* Every face asked, and a tree walked. */
static const AccelKind ACCELS[] = {ACCEL_NONE, ACCEL_BVH};
static const char *const ACCEL_NAMES[] = {"none", "bvh"};
enum { ACCEL_KINDS = sizeof ACCELS / sizeof ACCELS[0] };

/* Where every face is asked, all other work that could be left out is done, too, but for what the reference omits. */
enum { DOES_ALL = ((1 << SKIP_KINDS) - 1) & ~(1 << SKIP_LIGHT_BEHIND) };

/* How a kernel is built: `accel` is an index into ACCELS. */
typedef struct Build {
    int lanes, accel;
} Build;

/* Rich in everything, for what needs one scene only. */
static const char *const RICH_SCENE = "tests/scenes/many_lights.json";

static Error error;

void setUp(void)
{
    error = (Error){0};
}
void tearDown(void) {}

/* --- Pictures --- */

typedef struct Picture {
    int columns, rows;
    unsigned char *rgb;
    int bands, next_row;
    RenderReport report;
} Picture;

static bool take_band(void *user, int first_row, int rows, const unsigned char *rgb, const RenderReport *so_far,
                      Error *e)
{
    (void)so_far;
    (void)e;
    Picture *picture = user;
    TEST_ASSERT_EQUAL_INT_MESSAGE(picture->next_row, first_row, "bands come from the top, without gaps");
    TEST_ASSERT_LESS_OR_EQUAL(picture->rows, first_row + rows);
    size_t row_bytes = (size_t)picture->columns * 3;
    memcpy(picture->rgb + (size_t)first_row * row_bytes, rgb, (size_t)rows * row_bytes);
    picture->next_row += rows;
    picture->bands++;
    return true;
}

static Picture render(const Scene *scene, Backend backend, RenderSettings settings)
{
    Picture picture = {.columns = scene->screen.columns, .rows = scene->screen.rows};
    picture.rgb = calloc((size_t)picture.columns * (size_t)picture.rows, 3);
    TEST_ASSERT_NOT_NULL(picture.rgb);
    BandSink sink = {take_band, &picture};
    settings.device = -1;
    bool ok = backend == BACKEND_OPENCL ? opencl_render(scene, &settings, sink, &picture.report, &error)
                                        : reference_render(scene, &settings, sink, &picture.report, &error);
    TEST_ASSERT_TRUE_MESSAGE(ok, error.text);
    TEST_ASSERT_EQUAL_INT(picture.rows, picture.next_row);
    return picture;
}

static Picture render_reference(const Scene *scene)
{
    return render(scene, BACKEND_REFERENCE, (RenderSettings){.accel = ACCEL_NONE});
}

static Picture render_opencl(const Scene *scene, Precision precision, Build build)
{
    RenderSettings settings = {.precision = precision, .lanes = build.lanes, .accel = ACCELS[build.accel]};
    if (build.accel == 0)
        settings.no_skip = DOES_ALL;
    return render(scene, BACKEND_OPENCL, settings);
}

static size_t picture_bytes(const Picture *picture)
{
    return (size_t)picture->columns * (size_t)picture->rows * 3;
}

/* The largest difference of a pixel's three channels, in steps of 1/255. */
static int pixel_difference(const Picture *a, const Picture *b, int pixel)
{
    int most = 0;
    for (int i = 3 * pixel; i < 3 * pixel + 3; i++)
        most = abs(a->rgb[i] - b->rgb[i]) > most ? abs(a->rgb[i] - b->rgb[i]) : most;
    return most;
}

/* --- The two comparisons --- */

/* Says which picture it was and how to see it. */
static const char *describe(const char *path, const Picture *picture, const char *what, Build build, int pixel,
                            int difference)
{
    static char text[512];
    snprintf(text, sizeof text,
             "%s: pixel %d,%d is off by %d at %d lanes, --accel %s; see: rectray trace %s --size %dx%d --pixel %d,%d",
             what, pixel % picture->columns, pixel / picture->columns, difference, build.lanes,
             ACCEL_NAMES[build.accel], path, picture->columns, picture->rows, pixel % picture->columns,
             pixel / picture->columns);
    return text;
}

static void assert_double_equals(const char *path, const Scene *scene, const Picture *expected, Build build)
{
    Picture picture = render_opencl(scene, PRECISION_DOUBLE, build);
    for (int i = 0; i < expected->columns * expected->rows; i++) {
        int difference = pixel_difference(expected, &picture, i);
        if (difference > 0)
            TEST_FAIL_MESSAGE(describe(path, expected, "double", build, i, difference));
    }
    TEST_ASSERT_EQUAL_UINT64_MESSAGE(expected->report.rays.primary, picture.report.rays.primary, path);
    if (build.accel != 0) {
        free(picture.rgb);
        return;
    }
    TEST_ASSERT_EQUAL_UINT64_MESSAGE(expected->report.rays.shadow, picture.report.rays.shadow, path);
    TEST_ASSERT_EQUAL_UINT64_MESSAGE(expected->report.rays.reflection, picture.report.rays.reflection, path);
    TEST_ASSERT_EQUAL_UINT64_MESSAGE(expected->report.skipped[SKIP_LIGHT_BEHIND],
                                     picture.report.skipped[SKIP_LIGHT_BEHIND], path);
    free(picture.rgb);
}

/* Returns how many pixels are off by more than 1/255. */
static int assert_float_close(const char *path, const Scene *scene, const Picture *expected, Build build)
{
    Picture picture = render_opencl(scene, PRECISION_FLOAT, build);
    int pixels = expected->columns * expected->rows, allowed = pixels < 10000 ? 1 : pixels / 10000, off = 0;
    for (int i = 0; i < pixels; i++) {
        int difference = pixel_difference(expected, &picture, i);
        if (difference <= 1)
            continue;
        off++;
        if (!is_near_edge(scene, i % expected->columns, i / expected->columns))
            TEST_FAIL_MESSAGE(describe(path, expected, "float, away from any edge", build, i, difference));
        if (off > allowed)
            TEST_FAIL_MESSAGE(
                describe(path, expected, "float, too many pixels, the last of them", build, i, difference));
    }
    free(picture.rgb);
    return off;
}

/* --- Scenes --- */

static Scene load(const char *path)
{
    Scene scene;
    TEST_ASSERT_TRUE_MESSAGE(scene_load(&scene, path, &error), error.text);
    return scene;
}

static void resize(Scene *scene, int columns, int rows, int grid)
{
    scene->screen.columns = columns;
    scene->screen.rows = rows;
    scene->grid = grid;
    scene->adaptive = false;
}

static void for_each_scene(const char *pattern, void (*test)(const char *path))
{
    glob_t found;
    TEST_ASSERT_EQUAL_INT_MESSAGE(0, glob(pattern, 0, NULL, &found), pattern);
    for (size_t i = 0; i < found.gl_pathc; i++)
        test(found.gl_pathv[i]);
    globfree(&found);
}

/* Every kernel there is against the reference. */
static void compare_all(const char *path, const Scene *scene)
{
    Picture expected = render_reference(scene);
    for (int k = 0; k < LANE_KINDS * ACCEL_KINDS; k++) {
        Build build = {LANES[k / ACCEL_KINDS], k % ACCEL_KINDS};
        assert_double_equals(path, scene, &expected, build);
        assert_float_close(path, scene, &expected, build);
    }
    free(expected.rgb);
}

static void compare_small(const char *path)
{
    Scene scene = load(path);
    /* The small scenes in their own sizes, that some of them are made for. */
    if (scene.screen.columns * scene.screen.rows > 10000)
        resize(&scene, 61, 47, 1);
    compare_all(path, &scene);
    scene_free(&scene);
}

static void compare_at(const char *path, int columns, int rows)
{
    Scene scene = load(path);
    resize(&scene, columns, rows, 1);
    Picture expected = render_reference(&scene);
    const Build build = {0, 1};
    assert_double_equals(path, &scene, &expected, build);
    int off = assert_float_close(path, &scene, &expected, build);
    printf("%s: %d of %d pixels off in float, all at edges\n", path, off, expected.columns * expected.rows);
    free(expected.rgb);
    scene_free(&scene);
}

static void compare_medium(const char *path)
{
    compare_at(path, 197, 151);
}

static void compare_large(const char *path)
{
    compare_at(path, 331, 251);
}

static void backends_should_agree_on_every_test_scene(void)
{
    for_each_scene("tests/scenes/*.json", compare_small);
}

static void backends_should_agree_on_every_scene(void)
{
    for_each_scene("scenes/*.json", compare_small);
}

static void backends_should_agree_on_every_scene_in_large(void)
{
    for_each_scene("scenes/*.json", compare_large);
}

static void backends_should_agree_on_test_scenes_in_large(void)
{
    for_each_scene("tests/scenes/*.json", compare_medium);
}

static void backends_should_agree_at_sizes_that_are_multiples_of_nothing(void)
{
    const int sizes[][3] = {{1, 1, 1}, {1, 17, 1}, {97, 3, 1}, {2, 2, 3}, {5, 301, 1}, {13, 7, 3}, {19, 5, 16}};
    for (int s = 0; s < (int)(sizeof sizes / sizeof sizes[0]); s++) {
        Scene scene = load(RICH_SCENE);
        resize(&scene, sizes[s][0], sizes[s][1], sizes[s][2]);
        compare_all(RICH_SCENE, &scene);
        scene_free(&scene);
    }
}

/* --- Bands and threads --- */

static void tall_pictures_should_come_in_several_bands(void)
{
    Scene scene = load(RICH_SCENE);
    resize(&scene, 3, 700, 1);
    Picture expected = render_reference(&scene);
    TEST_ASSERT_GREATER_THAN(1, expected.bands);
    for (int k = 0; k < LANE_KINDS; k++) {
        Picture picture = render_opencl(&scene, PRECISION_DOUBLE, (Build){LANES[k], 0});
        TEST_ASSERT_GREATER_THAN(1, picture.bands);
        TEST_ASSERT_EQUAL_MEMORY(expected.rgb, picture.rgb, picture_bytes(&expected));
        free(picture.rgb);
    }
    free(expected.rgb);
    scene_free(&scene);
}

static void reference_should_give_the_same_bytes_on_any_number_of_threads(void)
{
    Scene scene = load(RICH_SCENE);
    Picture expected = render(&scene, BACKEND_REFERENCE, (RenderSettings){.threads = 1});
    for (int threads = 2; threads <= 4; threads++) {
        Picture picture = render(&scene, BACKEND_REFERENCE, (RenderSettings){.threads = threads});
        TEST_ASSERT_EQUAL_INT(threads, picture.report.threads);
        TEST_ASSERT_EQUAL_MEMORY(expected.rgb, picture.rgb, picture_bytes(&expected));
        TEST_ASSERT_EQUAL_MEMORY(&expected.report.rays, &picture.report.rays, sizeof picture.report.rays);
        free(picture.rgb);
    }
    free(expected.rgb);
    scene_free(&scene);
}

static void kernel_should_give_the_same_bytes_each_time(void)
{
    Scene scene = load(RICH_SCENE);
    const Build build = {0, 1};
    Picture first = render_opencl(&scene, PRECISION_FLOAT, build),
            second = render_opencl(&scene, PRECISION_FLOAT, build);
    TEST_ASSERT_EQUAL_MEMORY(first.rgb, second.rgb, picture_bytes(&first));
    free(first.rgb);
    free(second.rgb);
    scene_free(&scene);
}

static void scene_that_is_held_should_give_one_picture_after_another(void)
{
    Scene scene = load(RICH_SCENE);
    resize(&scene, 70, 50, 1);
    RenderSettings settings = {.device = -1};
    Picture once = render(&scene, BACKEND_OPENCL, settings), again = once;
    again.rgb = malloc(picture_bytes(&once));
    TEST_ASSERT_NOT_NULL(again.rgb);
    OpenclScene *held = opencl_hold(&scene, &settings, &error);
    TEST_ASSERT_NOT_NULL_MESSAGE(held, error.text);
    for (int i = 0; i < 3; i++) {
        again.next_row = 0;
        memset(again.rgb, 0, picture_bytes(&again));
        TEST_ASSERT_TRUE_MESSAGE(opencl_picture(held, (BandSink){take_band, &again}, &again.report, &error),
                                 error.text);
        TEST_ASSERT_EQUAL_MEMORY(once.rgb, again.rgb, picture_bytes(&once));
        TEST_ASSERT_EQUAL_UINT64_MESSAGE(once.report.rays.shadow, again.report.rays.shadow,
                                         "counted anew for each picture");
        TEST_ASSERT_EQUAL_UINT64(once.report.face_tests, again.report.face_tests);
        TEST_ASSERT_EQUAL_UINT64(opencl_held_report(held)->device_bytes, again.report.device_bytes);
    }
    opencl_release(held);
    free(once.rgb);
    free(again.rgb);
    scene_free(&scene);
}

/* Tiles that are traced by their corners, or begin with what those have left, and rays that all go their own way. */
static void assert_whole_tiles_change_nothing(const char *path, int columns, int rows)
{
    const AccelKind kinds[] = {ACCEL_BVH, ACCEL_KDTREE};
    Scene scene = load(path);
    resize(&scene, columns, rows, 1);
    for (int i = 0; i < 2; i++) {
        RenderSettings settings = {.accel = kinds[i]};
        Picture with = render(&scene, BACKEND_OPENCL, settings);
        settings.no_skip = 1u << SKIP_WHOLE_TILE;
        Picture without = render(&scene, BACKEND_OPENCL, settings);
        TEST_ASSERT_EQUAL_MEMORY_MESSAGE(without.rgb, with.rgb, picture_bytes(&with), path);
        TEST_ASSERT_EQUAL_UINT64_MESSAGE(without.report.rays.shadow, with.report.rays.shadow, path);
        if (with.report.lanes > 1) /* a device that traces one ray at a time has no tiles */
            TEST_ASSERT_GREATER_THAN_UINT64_MESSAGE(0, with.report.skipped[SKIP_WHOLE_TILE], path);
        free(with.rgb);
        free(without.rgb);
    }
    scene_free(&scene);
}

static void whole_tiles_should_not_change_a_byte(void)
{
    assert_whole_tiles_change_nothing("tests/scenes/doll_house.json", 480, 360);
    assert_whole_tiles_change_nothing("tests/scenes/one_sided.json", 300, 200);
    assert_whole_tiles_change_nothing("scenes/gallery.json", 500, 400);
    assert_whole_tiles_change_nothing("scenes/cornell.json", 300, 300);
    assert_whole_tiles_change_nothing("scenes/mirrors.json", 300, 200);
    assert_whole_tiles_change_nothing("scenes/original.json", 320, 240);
    assert_whole_tiles_change_nothing("tests/scenes/horizon.json", 32, 35);
    assert_whole_tiles_change_nothing("tests/scenes/forty_lights.json", 320, 240);
}

static bool refuse_band(void *user, int first_row, int rows, const unsigned char *rgb, const RenderReport *so_far,
                        Error *e)
{
    (void)first_row;
    (void)rows;
    (void)rgb;
    (void)so_far;
    ++*(int *)user;
    return error_set(e, ERROR_SYSTEM, "the disk is full");
}

static void sink_that_fails_should_stop_the_rendering(void)
{
    Scene scene = load(RICH_SCENE);
    resize(&scene, 3, 700, 1);
    RenderSettings settings = {.device = -1};
    RenderReport report;
    int calls = 0;
    TEST_ASSERT_FALSE(opencl_render(&scene, &settings, (BandSink){refuse_band, &calls}, &report, &error));
    TEST_ASSERT_EQUAL_STRING("the disk is full", error.text);
    error = (Error){0};
    TEST_ASSERT_FALSE(reference_render(&scene, &settings, (BandSink){refuse_band, &calls}, &report, &error));
    TEST_ASSERT_EQUAL_STRING("the disk is full", error.text);
    TEST_ASSERT_EQUAL_INT(2, calls);
    scene_free(&scene);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(backends_should_agree_on_every_test_scene);
    RUN_TEST(backends_should_agree_on_every_scene);
    RUN_TEST(backends_should_agree_on_test_scenes_in_large);
    RUN_TEST(backends_should_agree_on_every_scene_in_large);
    RUN_TEST(backends_should_agree_at_sizes_that_are_multiples_of_nothing);
    RUN_TEST(tall_pictures_should_come_in_several_bands);
    RUN_TEST(reference_should_give_the_same_bytes_on_any_number_of_threads);
    RUN_TEST(kernel_should_give_the_same_bytes_each_time);
    RUN_TEST(whole_tiles_should_not_change_a_byte);
    RUN_TEST(scene_that_is_held_should_give_one_picture_after_another);
    RUN_TEST(sink_that_fails_should_stop_the_rendering);
    return UNITY_END();
}
