/* Adaptive sampling: what it refines, what it leaves, and that both backends decide alike. */
#include "opencl/opencl.h"
#include "reader/scene_json.h"
#include "scene/light.h"
#include "trace/adaptive.h"
#include "trace/reference.h"
#include "trace/reference_render.h"

#include "support/small_scene.h"

#include "unity.h"

#include <glob.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static Error error;
static char message[512];

void setUp(void)
{
    error = (Error){0};
}
void tearDown(void) {}

/* --- Single pixels --- */

static Vec3 pixel_of(const Scene *scene, bool adaptive, int grid, int column, int row)
{
    Scene other = *scene;
    RenderReport report = {0};
    other.adaptive = adaptive;
    other.grid = grid;
    return reference_pixel(&(Tracer){.scene = &other, .report = &report}, column, row);
}

static void take_verdict(void *user, const Event *event)
{
    if (event->kind == EVENT_ADAPTIVE)
        *(AdaptiveVerdict *)user = event->as.adaptive;
}

static AdaptiveVerdict verdict_of(const Scene *scene, int column, int row)
{
    Scene other = *scene;
    RenderReport report = {0};
    AdaptiveVerdict verdict = {.light = -2};
    other.adaptive = true;
    other.grid = 2;
    reference_pixel(&(Tracer){.scene = &other, .report = &report, .recorder = &(Recorder){take_verdict, &verdict}},
                    column, row);
    return verdict;
}

static Vec3 difference(Vec3 a, Vec3 b)
{
    return vec3_sub(a, b);
}

static double largest(Vec3 a)
{
    return fmax(fabs(a.x), fmax(fabs(a.y), fabs(a.z)));
}

/* --- What is found --- */

/* A wall at z = -1 that fills a picture of 9 x 9 pixels, each 2/9 wide at the screen, and a light before it. */
static int wall_begin(SmallScene *small)
{
    small_scene_begin(small);
    small->scene.screen.columns = small->scene.screen.rows = 9;
    int white = small_scene_material(small, (Material){.diffuse = {1, 1, 1}});
    small_scene_face(small, white, face_quad(vec3(-9, -9, -1), vec3(9, -9, -1), vec3(9, 9, -1), vec3(-9, 9, -1)));
    small_scene_light(small, vec3(0, 0, 30));
    return small_scene_material(small, (Material){.ambient = {0, 0, 1}});
}

/* An upright pole at x, thinner than a thousandth of a pixel: no sample of any grid meets it. */
static void pole(SmallScene *small, double x, double z, int material)
{
    small_scene_face(small, material,
                     face_quad(vec3(x, -9, z), vec3(x + 1e-5, -9, z), vec3(x + 1e-5, 9, z), vec3(x, 9, z)));
}

static void adaptive_should_leave_an_even_wall_alone(void)
{
    SmallScene small;
    wall_begin(&small);
    for (int i = 0; i < 81; i++)
        TEST_ASSERT_EQUAL_INT(ADAPTIVE_SAME, verdict_of(&small.scene, i % 9, i / 9).reason);
}

/* Refined are the pixels of column 6, which the pole passes, and no others. */
static void assert_found(const SmallScene *small, AdaptiveReason reason, int hit)
{
    for (int i = 0; i < 81; i++) {
        AdaptiveVerdict verdict = verdict_of(&small->scene, i % 9, i / 9);
        snprintf(message, sizeof message, "column %d, row %d", i % 9, i / 9);
        TEST_ASSERT_EQUAL_INT_MESSAGE(i % 9 == 6 ? reason : ADAPTIVE_SAME, verdict.reason, message);
        TEST_ASSERT_EQUAL_INT_MESSAGE(i % 9 == 6 ? hit : 0, verdict.hit, message);
    }
}

static void adaptive_should_find_a_pole_between_all_samples(void)
{
    SmallScene small;
    int blue = wall_begin(&small);
    pole(&small, 0.41, 0, blue);       /* column 6 runs from 3/9 to 5/9 at z = 0 */
    small.lights[0].position.x = -100; /* the pole's shadow falls beside the picture */
    assert_found(&small, ADAPTIVE_FACE, 0);
}

/* The pole is behind the camera; at z = -1 the light from (0, 0, 30) doubles column 6's 6/9 .. 10/9, nearly. */
static void adaptive_should_find_the_shadow_of_a_pole(void)
{
    SmallScene small;
    int blue = wall_begin(&small);
    pole(&small, 0.8 * 10 / 31, 20, blue);
    assert_found(&small, ADAPTIVE_SHADOW, 0);
}

/* The wall is a mirror at z = -1; the camera's image is at z = -3. So a pole at z = 3 is three times as far off. */
static void adaptive_should_find_the_mirror_image_of_a_pole(void)
{
    SmallScene small;
    int blue = wall_begin(&small);
    small.materials[0] = (Material){.diffuse = {1, 1, 1}, .reflection = 0.5};
    pole(&small, 0.41 * 6, 3, blue);
    assert_found(&small, ADAPTIVE_FACE, 1);
}

static void adaptive_should_leave_out_mirrors_that_show_nothing(void)
{
    SmallScene small;
    int blue = wall_begin(&small);
    small.materials[0] = (Material){.diffuse = {1, 1, 1}, .reflection = 1e-5};
    pole(&small, 0.41 * 6, 3, blue);
    for (int i = 0; i < 81; i++)
        TEST_ASSERT_EQUAL_INT(ADAPTIVE_SAME, verdict_of(&small.scene, i % 9, i / 9).reason);
}

static void adaptive_should_leave_out_what_is_behind(void)
{
    SmallScene small;
    int blue = wall_begin(&small);
    pole(&small, 0.8, -1.001, blue); /* behind the wall */
    pole(&small, 0.8, 40, blue);     /* beyond the light and behind the camera */
    for (int i = 0; i < 81; i++)
        TEST_ASSERT_EQUAL_INT(ADAPTIVE_SAME, verdict_of(&small.scene, i % 9, i / 9).reason);
}

/* A highlight of a tenth of a pixel in pixel (63, 42), where neither its centre nor a corner shows it. */
static void adaptive_should_find_a_highlight_between_all_samples(void)
{
    SmallScene small;
    wall_begin(&small);
    small.scene.screen.columns = small.scene.screen.rows = 90;
    small.materials[0] = (Material){.specular = {1, 1, 1}, .shininess = 1e9};
    /* As far from the wall as the camera is: seen halfway between them. */
    small.lights[0].position = vec3(1.62, 0.2, 1);
    int found = 0;
    for (int i = 0; i < 8100; i++) {
        AdaptiveReason reason = verdict_of(&small.scene, i % 90, i / 90).reason;
        found += reason != ADAPTIVE_SAME;
        TEST_ASSERT_TRUE(reason == ADAPTIVE_SAME || reason == ADAPTIVE_HIGHLIGHT);
    }
    TEST_ASSERT_EQUAL_INT(ADAPTIVE_HIGHLIGHT, verdict_of(&small.scene, 63, 42).reason);
    TEST_ASSERT_LESS_THAN_INT(200, found);
}

/* --- Whole scenes --- */

static Scene load_small(const char *path, int columns, int rows)
{
    Scene scene;
    TEST_ASSERT_TRUE_MESSAGE(scene_load(&scene, path, &error), error.text);
    if (scene.screen.columns > columns || scene.screen.rows > rows) {
        scene.screen.columns = columns;
        scene.screen.rows = rows;
    }
    scene.adaptive = false;
    return scene;
}

static void for_each_scene(void (*test)(const char *path))
{
    glob_t found;
    TEST_ASSERT_EQUAL_INT(0, glob("scenes/*.json", 0, NULL, &found));
    TEST_ASSERT_EQUAL_INT(0, glob("tests/scenes/*.json", GLOB_APPEND, NULL, &found));
    for (size_t i = 0; i < found.gl_pathc; i++)
        test(found.gl_pathv[i]);
    globfree(&found);
}

/* Skips and adaptive sampling leave out what cannot add more than this. */
static void assert_no_brighter(const char *path)
{
    Scene scene = load_small(path, 23, 17);
    RenderReport report = {0};
    double brightest = adaptive_brightest(&scene), most = 0;
    for (int row = 0; row < scene.screen.rows; row++)
        for (int column = 0; column < scene.screen.columns; column++)
            most = fmax(most, largest(reference_pixel(&(Tracer){.scene = &scene, .report = &report}, column, row)));
    TEST_ASSERT_TRUE_MESSAGE(most <= brightest * (1 + 1e-12), path);
    scene_free(&scene);
}

static void no_pixel_should_be_brighter_than_the_bound(void)
{
    for_each_scene(assert_no_brighter);
}

/* Pixels so wide that a box beside and behind the eye has corners within all four sides of a beam that goes back. */
static void adaptive_should_leave_out_what_reaches_behind(void)
{
    Scene scene = load_small("tests/scenes/wide_pixels.json", 1, 40);
    TEST_ASSERT_EQUAL_INT(ADAPTIVE_SAME, verdict_of(&scene, 0, 21).reason);
    TEST_ASSERT_EQUAL_INT(ADAPTIVE_FACE, verdict_of(&scene, 0, 13).reason);
    scene_free(&scene);
}

enum { FINEST = 6 };

/* The average of a refined pixel, in other words: 16 samples of a grid of 16 x 16, each 13 rows below the last one,
 * modulo 16. */
static Vec3 average_of_lattice(const Scene *scene, int column, int row)
{
    Scene other = *scene;
    other.grid = 16;
    RenderReport report = {0};
    Tracer tracer = {.scene = &other, .report = &report};
    Vec3 sum = {0, 0, 0};
    for (int i = 0, j = 0; i < 16; i++, j = (j + 13) % 16)
        sum = vec3_add(sum, reference_sample(&tracer, column, row, i, j));
    return vec3(sum.x / 16, sum.y / 16, sum.z / 16);
}

static void adaptive_samples_should_be_a_power_of_two_as_the_grid_asks(void)
{
    for (int n = 2; n <= 64; n++) {
        int samples = adaptive_samples(n);
        TEST_ASSERT_EQUAL_INT(0, samples & (samples - 1));
        TEST_ASSERT_TRUE(samples >= 2 * n && 4 * samples >= n * n);
        TEST_ASSERT_TRUE(samples <= n * n && (samples < 4 * n || 2 * samples < n * n));
    }
}

/* The square of the shortest step from a sample to another, in cells, the lattice repeated all around. */
static int shortest_step(int samples, int generator)
{
    int shortest = samples * samples;
    for (int k = 1; k < samples; k++) {
        int down = k * generator % samples, i = k < samples - k ? k : samples - k,
            j = down < samples - down ? down : samples - down;
        shortest = i * i + j * j < shortest ? i * i + j * j : shortest;
    }
    return shortest;
}

static void adaptive_samples_should_keep_apart(void)
{
    for (int samples = 2; samples <= 1024; samples *= 2) {
        int chosen = adaptive_generator(samples), best = 0;
        for (int generator = 1; generator < samples; generator += 2) {
            int step = shortest_step(samples, generator);
            best = step > best ? step : best;
        }
        TEST_ASSERT_EQUAL_INT(1, chosen % 2); /* each row has a sample */
        TEST_ASSERT_EQUAL_INT(best, shortest_step(samples, chosen));
    }
}

/* A refined pixel is the average of the lattice's samples, bit for bit; any other is its centre, which tells the
 * average to half a step. */
static void check_pixels(const char *path)
{
    Scene scene = load_small(path, 23, 17);
    for (int i = 0; i < scene.screen.columns * scene.screen.rows; i++) {
        int column = i % scene.screen.columns, row = i / scene.screen.columns;
        bool refined = verdict_of(&scene, column, row).reason != ADAPTIVE_SAME;
        Vec3 pixel = pixel_of(&scene, true, FINEST, column, row);
        Vec3 plain = refined ? average_of_lattice(&scene, column, row) : pixel_of(&scene, false, 1, column, row);
        snprintf(message, sizeof message, "%s: pixel %d,%d of %d x %d, refined: %d", path, column, row,
                 scene.screen.columns, scene.screen.rows, refined);
        TEST_ASSERT_EQUAL_MEMORY_MESSAGE(&plain, &pixel, sizeof pixel, message);
        double off = refined ? 0 : largest(difference(pixel_of(&scene, false, 13, column, row), pixel));
        TEST_ASSERT_TRUE_MESSAGE(off < 0.5 / 255, message);
    }
    scene_free(&scene);
}

static void adaptive_should_give_the_lattice_or_the_centre_where_that_is_enough(void)
{
    for_each_scene(check_pixels);
}

static void check_trees(const char *path)
{
    Scene scene = load_small(path, 61, 47);
    Accel trees[2];
    const AccelKind kinds[] = {ACCEL_BVH, ACCEL_KDTREE};
    for (int t = 0; t < 2; t++)
        TEST_ASSERT_TRUE(accel_build(&trees[t], &scene, kinds[t], 1, &error));
    for (int i = 0; i < scene.screen.columns * scene.screen.rows; i++) {
        int column = i % scene.screen.columns, row = i / scene.screen.columns;
        bool refined = verdict_of(&scene, column, row).reason != ADAPTIVE_SAME;
        scene.adaptive = true;
        scene.grid = 2;
        for (int t = 0; t < 2; t++) {
            RenderReport report = {0};
            reference_pixel(&(Tracer){.scene = &scene, .accel = &trees[t], .report = &report}, column, row);
            snprintf(message, sizeof message, "%s: pixel %d,%d, tree %d", path, column, row, t);
            TEST_ASSERT_EQUAL_INT_MESSAGE(refined, report.refined_pixels, message);
        }
    }
    for (int t = 0; t < 2; t++)
        accel_free(&trees[t]);
    scene_free(&scene);
}

static void adaptive_should_decide_alike_with_any_tree(void)
{
    for_each_scene(check_trees);
}

/* --- Pictures --- */

typedef struct Picture {
    int columns, rows;
    unsigned char *rgb;
    double *linear;
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
    size_t values = (size_t)picture.columns * (size_t)picture.rows * 3;
    picture.rgb = calloc(values, 1);
    picture.linear = calloc(values, sizeof(double));
    BandSink sink = {take_band, &picture};
    settings.device = -1;
    if (backend == BACKEND_REFERENCE)
        settings.linear = picture.linear;
    bool ok = backend == BACKEND_OPENCL ? opencl_render(scene, &settings, sink, &picture.report, &error)
                                        : reference_render(scene, &settings, sink, &picture.report, &error);
    TEST_ASSERT_TRUE_MESSAGE(ok, error.text);
    return picture;
}

static void picture_free(Picture *picture)
{
    free(picture->rgb);
    free(picture->linear);
}

static double rmse(const Picture *a, const Picture *b)
{
    double sum = 0;
    int values = a->columns * a->rows * 3;
    for (int i = 0; i < values; i++)
        sum += (a->linear[i] - b->linear[i]) * (a->linear[i] - b->linear[i]);
    return sqrt(sum / values);
}

static void adaptive_should_err_less_the_finer_its_grid(void)
{
    Scene scene = load_small("scenes/gallery.json", 80, 45);
    scene.grid = 16;
    Picture truth = render(&scene, BACKEND_REFERENCE, (RenderSettings){0});
    double before = HUGE_VAL;
    scene.adaptive = true;
    for (scene.grid = 1; scene.grid <= 8; scene.grid *= 2) {
        Picture picture = render(&scene, BACKEND_REFERENCE, (RenderSettings){0});
        double now = rmse(&picture, &truth);
        TEST_ASSERT_TRUE(now < before);
        before = now;
        scene.adaptive = false;
        Picture uniform = render(&scene, BACKEND_REFERENCE, (RenderSettings){0});
        scene.adaptive = true;
        TEST_ASSERT_TRUE(scene.grid == 1 || now < rmse(&uniform, &truth));
        picture_free(&uniform);
        picture_free(&picture);
    }
    picture_free(&truth);
    scene_free(&scene);
}

/* The double kernel decides like the reference in every pixel; the float kernel may refine a few more. */
static void compare_backends(const char *path, int grid, Precision precision, int lanes, AccelKind accel)
{
    Scene scene = load_small(path, 131, 97);
    int pixels = scene.screen.columns * scene.screen.rows, off = 0;
    scene.adaptive = true;
    scene.grid = grid;
    Picture expected = render(&scene, BACKEND_REFERENCE, (RenderSettings){.accel = ACCEL_BVH});
    Picture picture =
        render(&scene, BACKEND_OPENCL, (RenderSettings){.precision = precision, .lanes = lanes, .accel = accel});
    for (int i = 0; i < 3 * pixels; i++)
        off += abs(picture.rgb[i] - expected.rgb[i]) > (precision == PRECISION_FLOAT);
    snprintf(message, sizeof message, "%s at %d lanes, grid %d", path, lanes, grid);
    if (precision == PRECISION_FLOAT) {
        TEST_ASSERT_TRUE_MESSAGE(picture.report.refined_pixels >= expected.report.refined_pixels, message);
        TEST_ASSERT_LESS_OR_EQUAL_INT_MESSAGE(3 * (1 + pixels / 10000), off, message);
    } else {
        TEST_ASSERT_EQUAL_INT_MESSAGE(0, off, message);
        TEST_ASSERT_EQUAL_UINT64_MESSAGE(expected.report.refined_pixels, picture.report.refined_pixels, message);
        TEST_ASSERT_EQUAL_MEMORY_MESSAGE(&expected.report.rays, &picture.report.rays, sizeof picture.report.rays,
                                         message);
    }
    picture_free(&picture);
    picture_free(&expected);
    scene_free(&scene);
}

static void adaptive_should_be_the_same_in_both_backends(void)
{
    const char *scenes[] = {"scenes/gallery.json",
                            "scenes/original.json",
                            "scenes/cornell.json",
                            "scenes/mirrors.json",
                            "tests/scenes/many_lights.json",
                            "tests/scenes/one_sided.json",
                            "tests/scenes/shadow_black.json",
                            "tests/scenes/split.json",
                            "tests/scenes/viewer_camera.json",
                            "tests/scenes/wide_pixels.json",
                            "tests/scenes/narrow_pixels.json"};
    for (int s = 0; s < (int)(sizeof scenes / sizeof *scenes); s++) {
        compare_backends(scenes[s], s % 2 ? 3 : 6, PRECISION_DOUBLE, 8, ACCEL_BVH);
        compare_backends(scenes[s], s % 2 ? 3 : 6, PRECISION_FLOAT, 16, ACCEL_BVH);
    }
    for (int lanes = 1; lanes <= 16; lanes *= 4)
        compare_backends("scenes/gallery.json", 6, PRECISION_DOUBLE, lanes, lanes == 16 ? ACCEL_NONE : ACCEL_BVH);
    compare_backends("scenes/gallery.json", 6, PRECISION_DOUBLE, 8, ACCEL_KDTREE);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(no_pixel_should_be_brighter_than_the_bound);
    RUN_TEST(adaptive_should_leave_an_even_wall_alone);
    RUN_TEST(adaptive_should_find_a_pole_between_all_samples);
    RUN_TEST(adaptive_should_find_the_shadow_of_a_pole);
    RUN_TEST(adaptive_should_find_the_mirror_image_of_a_pole);
    RUN_TEST(adaptive_should_leave_out_mirrors_that_show_nothing);
    RUN_TEST(adaptive_should_leave_out_what_is_behind);
    RUN_TEST(adaptive_should_leave_out_what_reaches_behind);
    RUN_TEST(adaptive_should_find_a_highlight_between_all_samples);
    RUN_TEST(adaptive_samples_should_be_a_power_of_two_as_the_grid_asks);
    RUN_TEST(adaptive_samples_should_keep_apart);
    RUN_TEST(adaptive_should_give_the_lattice_or_the_centre_where_that_is_enough);
    RUN_TEST(adaptive_should_decide_alike_with_any_tree);
    RUN_TEST(adaptive_should_err_less_the_finer_its_grid);
    RUN_TEST(adaptive_should_be_the_same_in_both_backends);
    return UNITY_END();
}
