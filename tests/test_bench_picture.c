/* What bench error measures with: differences of linear colours, fine pictures, the truth. */
#include "bench/bench_ground_truth.h"
#include "reader/scene_json.h"
#include "trace/reference.h"

#include "unity.h"

#include <math.h>
#include <string.h>

static Error error;
static Scene scene;
static const RenderSettings SETTINGS = {.device = -1};

void setUp(void)
{
    error = (Error){0};
}
void tearDown(void)
{
    scene_free(&scene);
}

static BenchPicture picture_of(int columns, const double *rgb)
{
    BenchPicture picture;
    TEST_ASSERT_TRUE(bench_picture_blank(&picture, columns, 1, &error));
    memcpy(picture.rgb, rgb, (size_t)columns * 3 * sizeof *rgb);
    return picture;
}

/* Squares of 0.3 and 0.1 over six values; one of two pixels is off by more than 1/255. */
static void difference_should_be_of_all_channels_and_of_pixels(void)
{
    BenchPicture a = picture_of(2, (const double[]){0.5, 0.5, 0.5, 0.2, 0.2, 0.2});
    BenchPicture b = picture_of(2, (const double[]){0.8, 0.4, 0.5, 0.2, 0.203, 0.2});
    BenchDifference difference = bench_difference(&a, &b);
    TEST_ASSERT_DOUBLE_WITHIN(1e-15, sqrt((0.09 + 0.01 + 0.000009) / 6), difference.rmse);
    TEST_ASSERT_DOUBLE_WITHIN(1e-15, 0.3, difference.most);
    TEST_ASSERT_EQUAL_DOUBLE(0.5, difference.off);
    bench_picture_free(&a);
    bench_picture_free(&b);
}

static void what_is_too_bright_for_a_picture_should_be_white_in_both(void)
{
    BenchPicture a = picture_of(1, (const double[]){7, 1, 0.75}), b = picture_of(1, (const double[]){1, 3, 1e18});
    BenchDifference difference = bench_difference(&a, &b);
    TEST_ASSERT_DOUBLE_WITHIN(1e-15, 0.25 / sqrt(3), difference.rmse);
    TEST_ASSERT_EQUAL_DOUBLE(0.25, difference.most);
    bench_picture_free(&a);
    bench_picture_free(&b);
}

static void bytes_should_be_within_half_a_step(void)
{
    BenchPicture a = picture_of(1, (const double[]){0.5, 0.1, 2});
    bench_picture_quantise(&a);
    TEST_ASSERT_EQUAL_DOUBLE(128 / 255.0, a.rgb[0]);
    TEST_ASSERT_EQUAL_DOUBLE(26 / 255.0, a.rgb[1]);
    TEST_ASSERT_EQUAL_DOUBLE(1, a.rgb[2]);
    bench_picture_free(&a);
}

static void load_small(const char *path)
{
    TEST_ASSERT_TRUE_MESSAGE(scene_load(&scene, path, &error), error.text);
    scene.screen.columns = 7;
    scene.screen.rows = 5;
}

/* The picture is traced larger and averaged; its rays are those of the grid, wherever that is divided. */
static void fine_pictures_should_have_the_colours_of_their_grid(void)
{
    static const int grids[] = {1, 7, 12, 63, 64};
    load_small("tests/scenes/many_lights.json");
    scene.screen.height = 1.1;
    for (int g = 0; g < 5; g++) {
        BenchPicture picture;
        RenderReport report = {0};
        TEST_ASSERT_TRUE_MESSAGE(bench_picture_fine(&picture, &scene, grids[g], &SETTINGS, &error), error.text);
        scene.grid = grids[g];
        for (int i = 0; i < 35; i += g < 3 ? 1 : 7) {
            Vec3 c = reference_pixel(&(Tracer){.scene = &scene, .report = &report}, i % 7, i / 7);
            TEST_ASSERT_DOUBLE_WITHIN(1e-12, c.x, picture.rgb[3 * i]);
            TEST_ASSERT_DOUBLE_WITHIN(1e-12, c.y, picture.rgb[3 * i + 1]);
            TEST_ASSERT_DOUBLE_WITHIN(1e-12, c.z, picture.rgb[3 * i + 2]);
        }
        bench_picture_free(&picture);
    }
}

/* The truth lies between its two grids, within a percent of a scene full of edges, and the reference confirms it. */
static void truth_should_know_how_far_off_it_is(void)
{
    load_small("tests/scenes/many_lights.json");
    BenchGroundTruth truth;
    BenchPicture finer;
    TEST_ASSERT_TRUE_MESSAGE(bench_ground_truth(&truth, &scene, &SETTINGS, &error), error.text);
    TEST_ASSERT_TRUE_MESSAGE(bench_picture_fine(&finer, &scene, 300, &SETTINGS, &error), error.text);
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, 0, truth.check);
    TEST_ASSERT_TRUE(truth.own_error > 0 && truth.own_error < 1e-3);
    /* 22 times the rays are 10 times as close: what is left between the two is the truth's error, known to a factor. */
    double actual = bench_difference(&truth.picture, &finer).rmse;
    TEST_ASSERT_TRUE(actual < 2 * truth.own_error && actual > truth.own_error / 4);
    bench_ground_truth_free(&truth);
    bench_picture_free(&finer);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(difference_should_be_of_all_channels_and_of_pixels);
    RUN_TEST(what_is_too_bright_for_a_picture_should_be_white_in_both);
    RUN_TEST(bytes_should_be_within_half_a_step);
    RUN_TEST(fine_pictures_should_have_the_colours_of_their_grid);
    RUN_TEST(truth_should_know_how_far_off_it_is);
    return UNITY_END();
}
