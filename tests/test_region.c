/* A region of the picture has the whole picture's pixels, whatever renders it, and costs no more than its blocks. */
#include "opencl/backend.h"
#include "reader/scene_json.h"

#include "unity.h"

#include <stdlib.h>
#include <string.h>

enum { COLUMNS = 100, ROWS = 90 };

/* Single pixels at corners, a column, a row, blocks of every size cut across, a block, all. */
static const Region REGIONS[] = {{0, 0, 1, 1},   {99, 89, 1, 1},   {50, 0, 1, 90},   {0, 45, 100, 1},
                                 {31, 29, 3, 5}, {17, 13, 70, 60}, {32, 32, 32, 32}, {0, 0, 100, 90}};
enum { REGION_KINDS = sizeof REGIONS / sizeof REGIONS[0] };

static Error error;

void setUp(void)
{
    error = (Error){0};
}
void tearDown(void) {}

/* --- Pictures --- */

typedef struct Picture {
    Region region;
    unsigned char rgb[COLUMNS * ROWS * 3];
    double linear[COLUMNS * ROWS * 3];
    int next_row;
    RenderReport report;
} Picture;

static bool take_band(void *user, int first_row, int rows, const unsigned char *rgb, const RenderReport *so_far,
                      Error *e)
{
    (void)so_far;
    (void)e;
    Picture *picture = user;
    TEST_ASSERT_EQUAL_INT_MESSAGE(picture->next_row, first_row, "bands come from the region's top, without gaps");
    TEST_ASSERT_GREATER_THAN_MESSAGE(0, rows, "a band has rows");
    size_t row_bytes = (size_t)picture->region.columns * 3;
    memcpy(picture->rgb + (size_t)first_row * row_bytes, rgb, (size_t)rows * row_bytes);
    picture->next_row += rows;
    return true;
}

static void render(Picture *picture, const Scene *scene, Backend backend, RenderSettings settings)
{
    memset(picture, 0, sizeof *picture);
    if (settings.linear)
        settings.linear = picture->linear;
    settings.device = -1;
    picture->region = render_region(&settings, scene);
    TEST_ASSERT_TRUE_MESSAGE(
        backend_render(backend, scene, &settings, (BandSink){take_band, picture}, &picture->report, &error),
        error.text);
    TEST_ASSERT_EQUAL_INT(picture->region.rows, picture->next_row);
}

/* --- Comparing --- */

static void assert_cut_out(const Picture *whole, const Picture *part, const char *what)
{
    const Region *r = &part->region;
    size_t bytes = (size_t)r->columns * 3;
    for (int row = 0; row < r->rows; row++) {
        size_t from = ((size_t)(r->row + row) * COLUMNS + (size_t)r->column) * 3, to = (size_t)row * bytes;
        TEST_ASSERT_EQUAL_MEMORY_MESSAGE(whole->rgb + from, part->rgb + to, bytes, what);
        TEST_ASSERT_EQUAL_MEMORY_MESSAGE(whole->linear + from, part->linear + to, bytes * sizeof(double), what);
    }
}

static Scene scene_at(const char *path, int grid, bool adaptive)
{
    Scene scene;
    TEST_ASSERT_TRUE_MESSAGE(scene_load(&scene, path, &error), error.text);
    scene.screen.columns = COLUMNS;
    scene.screen.rows = ROWS;
    scene.grid = grid;
    scene.adaptive = adaptive;
    return scene;
}

/* Renders the whole and the regions; `linear` in the settings only says that linear colours are wanted. */
static void assert_regions(const char *path, Backend backend, int grid, bool adaptive, RenderSettings settings)
{
    static Picture whole, part;
    static char what[128];
    Scene scene = scene_at(path, grid, adaptive);
    render(&whole, &scene, backend, settings);
    for (int i = 0; i < REGION_KINDS; i++) {
        const Region *r = &REGIONS[i];
        settings.region = *r;
        snprintf(what, sizeof what, "%s: region %d,%d,%dx%d, %s, %d lanes", path, r->column, r->row, r->columns,
                 r->rows, render_precisions[settings.precision], settings.lanes);
        render(&part, &scene, backend, settings);
        assert_cut_out(&whole, &part, what);
        uint64_t least = adaptive ? 1 : (uint64_t)(r->columns * r->rows * grid * grid);
        TEST_ASSERT_GREATER_OR_EQUAL_UINT64_MESSAGE(least, part.report.rays.primary, what);
        TEST_ASSERT_LESS_OR_EQUAL_UINT64_MESSAGE(whole.report.rays.primary, part.report.rays.primary, what);
    }
    scene_free(&scene);
}

static const char *const GALLERY = "scenes/gallery.json", *const MIRRORS = "scenes/mirrors.json";

static double linear_wanted;

static void lanes_should_cut_out_the_same_bytes(void)
{
    static const int lanes[] = {1, 4, 8, 16};
    for (int i = 0; i < 4; i++) {
        assert_regions(GALLERY, BACKEND_OPENCL, 1, false, (RenderSettings){.lanes = lanes[i], .accel = ACCEL_BVH});
        assert_regions(MIRRORS, BACKEND_OPENCL, 2, false,
                       (RenderSettings){.lanes = lanes[i], .precision = PRECISION_DOUBLE, .accel = ACCEL_NONE});
    }
}

static void adaptive_sampling_should_cut_out_the_same_bytes(void)
{
    assert_regions(GALLERY, BACKEND_OPENCL, 8, true, (RenderSettings){.lanes = 8});
    assert_regions(MIRRORS, BACKEND_OPENCL, 4, true, (RenderSettings){.precision = PRECISION_DOUBLE});
}

static void the_plain_kernel_should_cut_out_the_same_bytes(void)
{
    assert_regions(GALLERY, BACKEND_OPENCL, 2, false, (RenderSettings){.kernel = KERNEL_PLAIN, .accel = ACCEL_BVH});
}

static void linear_colours_should_be_cut_out_exactly(void)
{
    RenderSettings settings = {.linear = &linear_wanted};
    assert_regions(GALLERY, BACKEND_OPENCL, 1, false, settings);
    assert_regions(MIRRORS, BACKEND_REFERENCE, 1, false, settings);
}

static void the_reference_should_cut_out_the_same_bytes(void)
{
    assert_regions(GALLERY, BACKEND_REFERENCE, 2, true, (RenderSettings){.threads = 3});
    RenderSettings textbook = {.arithmetic = ARITHMETIC_TEXTBOOK, .shift = 1e-5f};
    assert_regions(MIRRORS, BACKEND_REFERENCE, 1, false, textbook);
}

/* --- What it costs --- */

static void nothing_should_be_traced_outside_the_region(void)
{
    Picture *picture = calloc(1, sizeof *picture);
    Scene scene = scene_at(GALLERY, 1, false);
    RenderSettings settings = {.region = {17, 13, 70, 60}};
    TEST_ASSERT_NOT_NULL(picture);
    render(picture, &scene, BACKEND_REFERENCE, settings);
    TEST_ASSERT_EQUAL_UINT64(70 * 60, picture->report.rays.primary);
    settings.lanes = 16; /* in blocks of 32 x 32 pixels */
    settings.region = (Region){33, 40, 10, 10};
    render(picture, &scene, BACKEND_OPENCL, settings);
    TEST_ASSERT_EQUAL_UINT64(32 * 32, picture->report.rays.primary);
    settings.region = (Region){31, 40, 10, 24};
    render(picture, &scene, BACKEND_OPENCL, settings);
    TEST_ASSERT_EQUAL_UINT64(64 * 32, picture->report.rays.primary);
    scene_free(&scene);
    free(picture);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(lanes_should_cut_out_the_same_bytes);
    RUN_TEST(adaptive_sampling_should_cut_out_the_same_bytes);
    RUN_TEST(the_plain_kernel_should_cut_out_the_same_bytes);
    RUN_TEST(linear_colours_should_be_cut_out_exactly);
    RUN_TEST(the_reference_should_cut_out_the_same_bytes);
    RUN_TEST(nothing_should_be_traced_outside_the_region);
    return UNITY_END();
}
