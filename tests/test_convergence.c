/* How fast the error falls with the rays that are spent, on edges, against exact coverage. */
#include "support/coverage.h"
#include "trace/adaptive.h"
#include "trace/reference.h"

#include "support/small_scene.h"

#include "unity.h"

enum { COLUMNS = 40, ROWS = 30, PIXELS = COLUMNS * ROWS };

static const int grids[] = {1, 2, 3, 4, 6, 8, 12, 16};
enum { GRIDS = sizeof grids / sizeof grids[0] };

static SmallScene small;
static RenderReport report;
static double truth[PIXELS];

/* White triangles that fan out from the middle, each edge at another angle, on black. */
static void fan(int triangles)
{
    small_scene_begin(&small);
    small.scene.screen.columns = COLUMNS;
    small.scene.screen.rows = ROWS;
    small.scene.shading.shadow = SHADOW_AMBIENT;
    small_scene_light(&small, vec3(0, 0, 9));
    int white = small_scene_material(&small, (Material){.ambient = {1, 1, 1}});
    for (int i = 0; i < triangles; i++) {
        double turn = 2 * 3.14159265358979 / triangles, angle = (i + 0.123) * turn;
        Vec3 tip = vec3(0.0137, -0.0211, 0);
        Vec3 a = vec3(2 * cos(angle), 2 * sin(angle), 0),
             b = vec3(2 * cos(angle + 0.47 * turn), 2 * sin(angle + 0.47 * turn), 0);
        small_scene_face(&small, white, face_triangle(tip, a, b));
    }
    for (int i = 0; i < PIXELS; i++)
        truth[i] = 1 - coverage_of_pixel(&small.scene, i % COLUMNS, i / COLUMNS).background;
}

static double rmse_of_grid(int n)
{
    double sum = 0;
    small.scene.grid = n;
    for (int i = 0; i < PIXELS; i++) {
        double error =
            reference_pixel(&(Tracer){.scene = &small.scene, .report = &report}, i % COLUMNS, i / COLUMNS).x - truth[i];
        sum += error * error;
    }
    return sqrt(sum / PIXELS);
}

void setUp(void) {}
void tearDown(void) {}
/* The slope of the straight line that is nearest to the points in the sense of least squares. */
static double slope(const double *x, const double *y, int count)
{
    double sx = 0, sy = 0, sxx = 0, sxy = 0;
    for (int i = 0; i < count; i++) {
        sx += x[i];
        sy += y[i];
        sxx += x[i] * x[i];
        sxy += x[i] * y[i];
    }
    return (count * sxy - sx * sy) / (count * sxx - sx * sx);
}

/* Rays fall on the sides of an edge as if by chance only where it enters and leaves a cell: of n rays about sqrt(n)
 * cells are in doubt, by half a ray each, and their errors have either sign. So the sum is off by some n^(1/4) rays. */
static void error_at_edges_should_fall_as_the_rays_to_the_power_of_three_quarters(void)
{
    double log_rays[GRIDS], log_error[GRIDS];
    fan(33);
    for (int i = 0; i < GRIDS; i++) {
        log_rays[i] = 2 * log(grids[i]);
        log_error[i] = log(rmse_of_grid(grids[i]));
        TEST_ASSERT_TRUE_MESSAGE(i == 0 || log_error[i] < log_error[i - 1], "a finer grid has a larger error");
    }
    double power = -slope(log_rays, log_error, GRIDS);
    printf("the error falls as the rays to the power of -%.3f\n", power);
    TEST_ASSERT_TRUE(power >= 0.75);
}

/* Pixels that are one colour need no more than their centre, and a lattice is no worse than a grid of as many samples,
 * but for a quarter more where edges run in all directions. */
static void adaptive_error_should_fall_likewise_and_be_that_of_a_grid_of_as_many_samples(void)
{
    enum { COUNT = 4 };
    static const int finest[COUNT] = {2, 8, 16, 32}, same[COUNT] = {2, 4, 8, 16}; /* 4, 16, 64 and 256 samples */
    double log_samples[COUNT], log_error[COUNT];
    fan(33);
    for (int i = 0; i < COUNT; i++) {
        small.scene.adaptive = false;
        double uniform = rmse_of_grid(same[i]);
        small.scene.adaptive = true;
        double adaptive = rmse_of_grid(finest[i]);
        TEST_ASSERT_EQUAL_INT(same[i] * same[i], adaptive_samples(finest[i]));
        TEST_ASSERT_TRUE(adaptive < 1.3 * uniform);
        log_samples[i] = log(adaptive_samples(finest[i]));
        log_error[i] = log(adaptive);
        TEST_ASSERT_TRUE_MESSAGE(i == 0 || log_error[i] < log_error[i - 1], "more samples have a larger error");
    }
    double power = -slope(log_samples, log_error, COUNT);
    printf("the error of lattices falls as their samples to the power of -%.3f\n", power);
    TEST_ASSERT_TRUE(power >= 0.75);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(adaptive_error_should_fall_likewise_and_be_that_of_a_grid_of_as_many_samples);
    RUN_TEST(error_at_edges_should_fall_as_the_rays_to_the_power_of_three_quarters);
    return UNITY_END();
}
