/* The truth about a scene's pixels. */
#include "bench/bench_ground_truth.h"

#include "trace/accel.h"
#include "trace/reference.h"

#include <math.h>
#include <stddef.h>

enum { MOST_PIXELS = 1 << 22 }; /* of the larger picture: 100 MB of colours */

/* How many pixels of the larger picture, across and down, make
 * one: the largest divisor of the grid that the limits allow. */
static int block_size(const Scene *scene, int grid)
{
    for (int block = grid; block > 1; block--) {
        long long columns = (long long)scene->screen.columns * block, rows = (long long)scene->screen.rows * block;
        if (grid % block == 0 && columns * rows <= MOST_PIXELS && columns <= SCENE_MAX_PIXELS &&
            rows <= SCENE_MAX_PIXELS)
            return block;
    }
    return 1;
}

static void average_blocks(BenchPicture *picture, const BenchPicture *large, int block)
{
    for (int row = 0; row < large->rows; row++)
        for (int column = 0; column < large->columns; column++) {
            const double *from = large->rgb + 3 * ((size_t)row * (size_t)large->columns + (size_t)column);
            double *to =
                picture->rgb + 3 * ((size_t)(row / block) * (size_t)picture->columns + (size_t)(column / block));
            for (int k = 0; k < 3; k++)
                to[k] += from[k] / (block * block);
        }
}

bool bench_picture_fine(BenchPicture *picture, const Scene *scene, int grid, const RenderSettings *settings,
                        Error *error)
{
    int block = block_size(scene, grid);
    Scene wide = *scene;
    BenchPicture large;
    RenderSettings exact = *settings;
    exact.precision = PRECISION_DOUBLE;
    wide.screen.height = screen_height(&scene->screen);
    wide.screen.columns *= block;
    wide.screen.rows *= block;
    wide.grid = grid / block;
    wide.adaptive = false;
    bool ok = bench_picture_blank(picture, scene->screen.columns, scene->screen.rows, error);
    ok = bench_picture(&large, &wide, BACKEND_OPENCL, &exact, error) && ok;
    if (ok)
        average_blocks(picture, &large, block);
    bench_picture_free(&large);
    return ok;
}

/* The largest difference from the reference at pixels spread over the picture by multiples of the golden section. */
static bool check_pixels(const BenchPicture *picture, const Scene *scene, double *most, Error *error)
{
    Accel accel;
    RenderReport unused = {0};
    Scene fine = *scene;
    fine.grid = TRUTH_GRID;
    fine.adaptive = false;
    bool ok = accel_build(&accel, scene, ACCEL_AUTO, 0, error);
    *most = 0;
    for (int i = 0; i < TRUTH_CHECKS && ok; i++) {
        int column = (int)(fmod(0.6180339887498949 * (i + 1), 1) * picture->columns);
        int row = (int)((i + 0.5) / TRUTH_CHECKS * picture->rows);
        Vec3 c = reference_pixel(&(Tracer){.scene = &fine, .accel = &accel, .report = &unused}, column, row);
        const double *rgb = picture->rgb + 3 * ((size_t)row * (size_t)picture->columns + (size_t)column);
        *most = fmax(*most, fmax(fabs(rgb[0] - c.x), fmax(fabs(rgb[1] - c.y), fabs(rgb[2] - c.z))));
    }
    accel_free(&accel);
    return ok;
}

bool bench_ground_truth(BenchGroundTruth *truth, const Scene *scene, const RenderSettings *settings, Error *error)
{
    BenchPicture other = {0};
    *truth = (BenchGroundTruth){0};
    bool ok = bench_picture_fine(&truth->picture, scene, TRUTH_GRID, settings, error) &&
              bench_picture_fine(&other, scene, TRUTH_GRID - 1, settings, error) &&
              check_pixels(&truth->picture, scene, &truth->check, error);
    if (ok) {
        truth->own_error = bench_difference(&truth->picture, &other).rmse / 2;
        size_t count = (size_t)other.columns * (size_t)other.rows * 3;
        for (size_t i = 0; i < count; i++)
            truth->picture.rgb[i] = (truth->picture.rgb[i] + other.rgb[i]) / 2;
    }
    bench_picture_free(&other);
    return ok;
}

void bench_ground_truth_free(BenchGroundTruth *truth)
{
    bench_picture_free(&truth->picture);
}
