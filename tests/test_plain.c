/* The plain kernel against the reference, in both arithmetics, on every scene in scenes/ and tests/scenes/.
 * Exact: in double the same bytes and the same counts; in float off by more than 1/255 as seldom as the packet kernel,
 * and only beside edges. Textbook: the same bytes and counts as textbook.c in either precision, for all that both do is
 * rounded alike. A new scene file is tested without a word here. */
#include "opencl/opencl.h"
#include "reader/scene_json.h"
#include "trace/reference_render.h"
#include "trace/textbook.h"

#include "support/near_edge.h"

#include "unity.h"

#include <glob.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const char *const RICH_SCENE = "tests/scenes/many_lights.json";
static const AccelKind ACCELS[] = {ACCEL_NONE, ACCEL_KDTREE, ACCEL_BVH};
enum { ACCEL_KINDS = sizeof ACCELS / sizeof ACCELS[0] };

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
    RenderReport report;
} Picture;

static bool take_band(void *user, int first_row, int rows, const unsigned char *rgb, const RenderReport *so_far,
                      Error *e)
{
    (void)so_far, (void)e;
    Picture *picture = user;
    size_t row_bytes = (size_t)picture->columns * 3;
    memcpy(picture->rgb + (size_t)first_row * row_bytes, rgb, (size_t)rows * row_bytes);
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
    return picture;
}

static RenderSettings plain(Precision precision, AccelKind accel, Arithmetic arithmetic)
{
    return (RenderSettings){
        .kernel = KERNEL_PLAIN, .precision = precision, .accel = accel, .arithmetic = arithmetic, .shift = SCENE_SHIFT};
}

/* The largest difference of a pixel's three channels, in steps of 1/255. */
static int pixel_difference(const Picture *a, const Picture *b, int pixel)
{
    int most = 0;
    for (int i = 3 * pixel; i < 3 * pixel + 3; i++)
        most = abs(a->rgb[i] - b->rgb[i]) > most ? abs(a->rgb[i] - b->rgb[i]) : most;
    return most;
}

/* What to run to see it. */
static const char *describe(const char *path, const Picture *picture, const RenderSettings *settings, int pixel)
{
    static char text[512];
    snprintf(text, sizeof text,
             "pixel %d,%d; see: rectray render %s --sampling uniform --size %dx%d --kernel plain --precision %s "
             "--accel %s --arithmetic %s",
             pixel % picture->columns, pixel / picture->columns, path, picture->columns, picture->rows,
             render_precisions[settings->precision], render_accels[settings->accel],
             render_arithmetics[settings->arithmetic]);
    return text;
}

static void assert_same(const char *path, const Picture *expected, const Picture *picture,
                        const RenderSettings *settings)
{
    for (int i = 0; i < expected->columns * expected->rows; i++)
        if (pixel_difference(expected, picture, i) > 0)
            TEST_FAIL_MESSAGE(describe(path, expected, settings, i));
    const RenderReport *a = &expected->report, *b = &picture->report;
    TEST_ASSERT_EQUAL_UINT64_MESSAGE(a->rays.primary, b->rays.primary, path);
    TEST_ASSERT_EQUAL_UINT64_MESSAGE(a->rays.shadow, b->rays.shadow, path);
    TEST_ASSERT_EQUAL_UINT64_MESSAGE(a->rays.reflection, b->rays.reflection, path);
    TEST_ASSERT_EQUAL_UINT64_MESSAGE(a->skipped[SKIP_LIGHT_BEHIND], b->skipped[SKIP_LIGHT_BEHIND], path);
    if (settings->accel == ACCEL_NONE) { /* each tree has its own way */
        TEST_ASSERT_EQUAL_UINT64_MESSAGE(a->face_tests, b->face_tests, path);
        TEST_ASSERT_EQUAL_UINT64_MESSAGE(0, b->box_tests, path);
    }
}

/* --- Scenes --- */

/* In their own sizes where they are small: some are made for them. */
static Scene load(const char *path)
{
    Scene scene;
    TEST_ASSERT_TRUE_MESSAGE(scene_load(&scene, path, &error), error.text);
    if (scene.screen.columns * scene.screen.rows > 10000) {
        scene.screen.columns = 61;
        scene.screen.rows = 47;
    }
    scene.grid = scene.adaptive ? 1 : scene.grid;
    scene.adaptive = false;
    return scene;
}

static void for_each_scene(void (*test)(const char *path, const Scene *scene))
{
    const char *const patterns[] = {"scenes/*.json", "tests/scenes/*.json"};
    for (int p = 0; p < 2; p++) {
        glob_t found;
        TEST_ASSERT_EQUAL_INT_MESSAGE(0, glob(patterns[p], 0, NULL, &found), patterns[p]);
        for (size_t i = 0; i < found.gl_pathc; i++) {
            Scene scene = load(found.gl_pathv[i]);
            test(found.gl_pathv[i], &scene);
            scene_free(&scene);
        }
        globfree(&found);
    }
}

/* --- Exact arithmetic --- */

static void compare_double(const char *path, const Scene *scene)
{
    Picture expected = render(scene, BACKEND_REFERENCE, (RenderSettings){.accel = ACCEL_NONE});
    for (int k = 0; k < ACCEL_KINDS; k++) {
        RenderSettings settings = plain(PRECISION_DOUBLE, ACCELS[k], ARITHMETIC_EXACT);
        Picture picture = render(scene, BACKEND_OPENCL, settings);
        assert_same(path, &expected, &picture, &settings);
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
    Scene scene = load(RICH_SCENE);
    scene.screen.columns = 3;
    scene.screen.rows = 700; /* several bands */
    compare_double(RICH_SCENE, &scene);
    scene_free(&scene);
}

static void compare_float(const char *path, const Scene *scene)
{
    RenderSettings settings = plain(PRECISION_FLOAT, ACCEL_AUTO, ARITHMETIC_EXACT);
    Picture expected = render(scene, BACKEND_REFERENCE, (RenderSettings){.accel = ACCEL_AUTO});
    Picture picture = render(scene, BACKEND_OPENCL, settings);
    int pixels = expected.columns * expected.rows, allowed = pixels < 10000 ? 1 : pixels / 10000, off = 0;
    for (int i = 0; i < pixels; i++)
        if (pixel_difference(&expected, &picture, i) > 1) {
            bool near_edge = is_near_edge(scene, i % expected.columns, i / expected.columns);
            TEST_ASSERT_TRUE_MESSAGE(near_edge, describe(path, &expected, &settings, i));
            TEST_ASSERT_LESS_OR_EQUAL_MESSAGE(allowed, ++off, describe(path, &expected, &settings, i));
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
    Scene scene = load(RICH_SCENE);
    scene.grid = 2;
    size_t values = (size_t)scene.screen.columns * (size_t)scene.screen.rows * 3;
    double *expected = calloc(values, sizeof *expected), *found = calloc(values, sizeof *found);
    Picture reference = render(&scene, BACKEND_REFERENCE, (RenderSettings){.linear = expected});
    RenderSettings settings = plain(PRECISION_DOUBLE, ACCEL_AUTO, ARITHMETIC_EXACT);
    settings.linear = found;
    Picture picture = render(&scene, BACKEND_OPENCL, settings);
    assert_same(RICH_SCENE, &reference, &picture, &settings);
    for (size_t i = 0; i < values; i++)
        TEST_ASSERT_DOUBLE_WITHIN(1e-12, expected[i], found[i]);
    free(reference.rgb);
    free(picture.rgb);
    free(expected);
    free(found);
    scene_free(&scene);
}

/* --- Textbook arithmetic --- */

static void compare_textbook(const char *path, const Scene *scene)
{
    for (int precision = PRECISION_FLOAT; precision <= PRECISION_DOUBLE; precision++) {
        RenderSettings settings = plain((Precision)precision, ACCEL_NONE, ARITHMETIC_TEXTBOOK);
        Picture expected = render(scene, BACKEND_REFERENCE, settings),
                picture = render(scene, BACKEND_OPENCL, settings);
        assert_same(path, &expected, &picture, &settings);
        free(expected.rgb);
        free(picture.rgb);
    }
}

static void textbook_kernel_should_equal_the_textbook_reference_on_every_scene(void)
{
    for_each_scene(compare_textbook);
}

/* Both textbooks at once could be wrong: where rounding decides nothing they say what the reference says. */
static void textbook_in_double_should_say_what_the_exact_arithmetic_says_but_for_few_pixels(void)
{
    Scene scene = load("scenes/gallery.json");
    Picture exact = render(&scene, BACKEND_REFERENCE, (RenderSettings){.accel = ACCEL_AUTO});
    for (int k = 0; k < ACCEL_KINDS; k++) {
        RenderSettings settings = plain(PRECISION_DOUBLE, ACCELS[k], ARITHMETIC_TEXTBOOK);
        Picture picture = render(&scene, BACKEND_OPENCL, settings);
        int off = 0;
        for (int i = 0; i < exact.columns * exact.rows; i++)
            off += pixel_difference(&exact, &picture, i) > 1;
        TEST_ASSERT_LESS_OR_EQUAL(2, off);
        free(picture.rgb);
    }
    free(exact.rgb);
    scene_free(&scene);
}

static void shift_should_decide_whether_a_face_shadows_itself(void)
{
    Scene scene = load("scenes/cornell.json");
    RenderSettings settings = plain(PRECISION_FLOAT, ACCEL_NONE, ARITHMETIC_TEXTBOOK);
    uint64_t reflections[2];
    const float shifts[] = {0, 1e-3f};
    for (int i = 0; i < 2; i++) {
        settings.shift = shifts[i];
        Picture picture = render(&scene, BACKEND_REFERENCE, settings);
        reflections[i] = picture.report.rays.reflection;
        free(picture.rgb);
    }
    TEST_ASSERT_GREATER_THAN_UINT64_MESSAGE(reflections[1], reflections[0], "mirrors that meet themselves");
    scene_free(&scene);
}

/* --- What there is not --- */

static void assert_refused(const Scene *scene, Backend backend, RenderSettings settings, const char *way_out)
{
    RenderReport report;
    BandSink sink = {take_band, NULL};
    settings.device = -1;
    error = (Error){0};
    TEST_ASSERT_FALSE(backend == BACKEND_OPENCL ? opencl_render(scene, &settings, sink, &report, &error)
                                                : reference_render(scene, &settings, sink, &report, &error));
    TEST_ASSERT_EQUAL_INT(ERROR_USAGE, error.kind);
    TEST_ASSERT_NOT_NULL_MESSAGE(strstr(error.text, way_out), error.text);
}

static void what_is_not_there_should_be_refused_with_the_way_out(void)
{
    Scene scene = load(RICH_SCENE);
    RenderSettings exact = plain(PRECISION_FLOAT, ACCEL_AUTO, ARITHMETIC_EXACT), textbook = exact;
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
    RUN_TEST(textbook_kernel_should_equal_the_textbook_reference_on_every_scene);
    RUN_TEST(textbook_in_double_should_say_what_the_exact_arithmetic_says_but_for_few_pixels);
    RUN_TEST(shift_should_decide_whether_a_face_shadows_itself);
    RUN_TEST(what_is_not_there_should_be_refused_with_the_way_out);
    return UNITY_END();
}
