/* scenes/mirrors.json against the closed form that its comment states: a piece of a geometric series in every pixel,
 * from the reference tracer within 1e-6, and in bytes from both backends. */
#include "opencl/opencl.h"
#include "reader/scene_json.h"
#include "trace/reference.h"
#include "trace/reference_render.h"

#include "unity.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static const double Q = 0.75;
static const Vec3 RIGHT = {0.30, 0.13, 0.04}, LEFT = {0.02, 0.10, 0.22}, SKY = {0.93, 0.90, 0.82};
static const int BOUNCES[] = {0, 1, 2, 3, 7, 16, 64};
enum { BOUNCES_COUNT = sizeof BOUNCES / sizeof BOUNCES[0] };

static Scene scene;

/* The value of a pixel, and whether its ray passes so close to a mirror's edge that rounding may decide. */
typedef struct Expected {
    Vec3 colour;
    bool near_edge;
} Expected;

/* 1 + Q^2 + Q^4 ... of so many terms. */
static double every_second(int terms)
{
    return (1 - pow(Q, 2 * terms)) / (1 - Q * Q);
}

/* The parameter at which a ray from o along r comes to +-limit. */
static double leaves_at(double o, double r, double limit)
{
    return r == 0 ? HUGE_VAL : (copysign(limit, r) - o) / r;
}

static Expected closed_form(int column, int row)
{
    View view = view_of(&scene);
    Vec3 o = vec3_add(view.eye, scene.centre), r = view_direction(&view, column, row, 0, 0);
    double leaves = fmin(leaves_at(o.y, r.y, 1.3), fmin(leaves_at(o.z, r.z, r.z < 0 ? 9 : 1), 1e9));
    /* Crossing k comes at t = (2k + 1 - ox sign rx) / |rx|; `last` is the real k that comes at t = leaves. */
    double last = (fabs(r.x) * leaves + copysign(o.x, r.x * o.x) - 1) / 2;
    int m = last < 0 ? 0 : (int)floor(last) + 1, n = scene.shading.max_bounces;
    int hits = m < n + 1 ? m : n + 1;
    Vec3 first = r.x > 0 ? RIGHT : LEFT, second = r.x > 0 ? LEFT : RIGHT;
    Vec3 colour =
        vec3_add(vec3_scale(every_second((hits + 1) / 2), first), vec3_scale(Q * every_second(hits / 2), second));
    if (m <= n)
        colour = vec3_add(colour, vec3_scale(pow(Q, m), SKY));
    return (Expected){colour, fabs(last - floor(last + 0.5)) < 1e-5 * (1 + fabs(last))};
}

static double largest_difference(Vec3 a, Vec3 b)
{
    return fmax(fabs(a.x - b.x), fmax(fabs(a.y - b.y), fabs(a.z - b.z)));
}

void setUp(void)
{
    static Error error; /* it is large */
    error = (Error){0};
    if (!scene_load(&scene, "scenes/mirrors.json", &error))
        TEST_FAIL_MESSAGE(error.text);
}

void tearDown(void)
{
    scene_free(&scene);
}

/* Fewer than one pixel in 200 may be too close to an edge to tell. */
static void pixels_match(void)
{
    RenderReport report = {0};
    double worst = 0;
    int near_edge = 0;
    for (int row = 0; row < scene.screen.rows; row++)
        for (int column = 0; column < scene.screen.columns; column++) {
            Expected expected = closed_form(column, row);
            Vec3 colour = reference_pixel(&(Tracer){.scene = &scene, .report = &report}, column, row);
            near_edge += expected.near_edge;
            if (!expected.near_edge)
                worst = fmax(worst, largest_difference(colour, expected.colour));
        }
    TEST_ASSERT_DOUBLE_WITHIN(1e-6, 0, worst);
    TEST_ASSERT_LESS_THAN(scene.screen.rows * scene.screen.columns / 200, near_edge);
}

static void pixels_should_be_pieces_of_a_geometric_series(void)
{
    for (int i = 0; i < BOUNCES_COUNT; i++) {
        scene.shading.max_bounces = BOUNCES[i];
        pixels_match();
    }
}

/* Seen along their common normal, the mirrors show one another until the bounces run out. */
static void look_straight_into_a_mirror(void)
{
    scene.camera.look_at = vec3_add(scene.camera.position, vec3(1, 0.004, -0.007));
    scene.screen.width = 0.2;
}

static void straight_into_a_mirror_the_series_should_reach_its_limit(void)
{
    look_straight_into_a_mirror();
    for (int i = 0; i < BOUNCES_COUNT; i++) {
        scene.shading.max_bounces = BOUNCES[i];
        pixels_match();
    }
    RenderReport report = {0};
    Vec3 limit = vec3_scale(1 / (1 - Q * Q), vec3_add(RIGHT, vec3_scale(Q, LEFT)));
    Vec3 colour =
        reference_pixel(&(Tracer){.scene = &scene, .report = &report}, scene.screen.columns / 2, scene.screen.rows / 2);
    TEST_ASSERT_EQUAL_UINT64(64, report.rays.reflection);
    TEST_ASSERT_DOUBLE_WITHIN(1e-6, 0, largest_difference(colour, limit));
}

static bool keep_band(void *user, int first_row, int rows, const unsigned char *rgb, const RenderReport *so_far,
                      Error *error)
{
    (void)so_far, (void)error;
    size_t row_bytes = (size_t)scene.screen.columns * 3;
    memcpy((unsigned char *)user + (size_t)first_row * row_bytes, rgb, (size_t)rows * row_bytes);
    return true;
}

typedef bool (*RenderFunction)(const Scene *, const RenderSettings *, BandSink, RenderReport *, Error *);

/* Every byte is within half a step of 255 c, but for the error that c may have. */
static void bytes_match(RenderFunction render, Precision precision, double error_of_c)
{
    static Error error;
    error = (Error){0};
    RenderSettings settings = {.precision = precision, .accel = ACCEL_NONE, .device = -1};
    RenderReport report;
    unsigned char *rgb = malloc((size_t)scene.screen.columns * (size_t)scene.screen.rows * 3);
    TEST_ASSERT_NOT_NULL(rgb);
    if (!render(&scene, &settings, (BandSink){keep_band, rgb}, &report, &error))
        TEST_FAIL_MESSAGE(error.text);
    double worst = 0;
    const unsigned char *byte = rgb;
    for (int row = 0; row < scene.screen.rows; row++)
        for (int column = 0; column < scene.screen.columns; column++, byte += 3) {
            Expected expected = closed_form(column, row);
            if (!expected.near_edge)
                worst =
                    fmax(worst, largest_difference(vec3(byte[0], byte[1], byte[2]), vec3_scale(255, expected.colour)));
        }
    free(rgb);
    TEST_ASSERT_DOUBLE_WITHIN(0.5 + 255 * error_of_c, 0, worst);
}

static void bytes_of_the_reference_should_be_those_of_the_series(void)
{
    for (int i = 0; i < BOUNCES_COUNT; i++) {
        scene.shading.max_bounces = BOUNCES[i];
        bytes_match(reference_render, PRECISION_DOUBLE, 1e-6);
    }
}

static void bytes_of_opencl_should_be_those_of_the_series(void)
{
    const Precision precisions[] = {PRECISION_FLOAT, PRECISION_DOUBLE};
    const double errors[] = {1e-4, 1e-6};
    for (int p = 0; p < 2; p++)
        for (int i = 0; i < BOUNCES_COUNT; i++) {
            scene.shading.max_bounces = BOUNCES[i];
            bytes_match(opencl_render, precisions[p], errors[p]);
        }
}

static void bytes_should_hold_straight_into_a_mirror(void)
{
    look_straight_into_a_mirror();
    scene.shading.max_bounces = 64;
    bytes_match(reference_render, PRECISION_DOUBLE, 1e-6);
    bytes_match(opencl_render, PRECISION_FLOAT, 1e-4);
    bytes_match(opencl_render, PRECISION_DOUBLE, 1e-6);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(pixels_should_be_pieces_of_a_geometric_series);
    RUN_TEST(straight_into_a_mirror_the_series_should_reach_its_limit);
    RUN_TEST(bytes_of_the_reference_should_be_those_of_the_series);
    RUN_TEST(bytes_of_opencl_should_be_those_of_the_series);
    RUN_TEST(bytes_should_hold_straight_into_a_mirror);
    return UNITY_END();
}
