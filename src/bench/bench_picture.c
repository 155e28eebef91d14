/* Pictures in linear colours. */
#include "bench/bench_picture.h"

#include "opencl/backend.h"
#include "scene/light.h"

#include <math.h>
#include <stdlib.h>

static size_t value_count(const BenchPicture *picture)
{
    return (size_t)picture->columns * (size_t)picture->rows * 3;
}

static bool drop_band(void *user, int first_row, int rows, const unsigned char *rgb, const RenderReport *so_far,
                      Error *error)
{
    (void)user, (void)first_row, (void)rows, (void)rgb, (void)so_far, (void)error;
    return true;
}

bool bench_picture_blank(BenchPicture *picture, int columns, int rows, Error *error)
{
    *picture = (BenchPicture){.columns = columns, .rows = rows};
    picture->rgb = calloc(value_count(picture), sizeof *picture->rgb);
    return picture->rgb || error_memory(error, "a picture in linear colours");
}

bool bench_picture(BenchPicture *picture, const Scene *scene, Backend backend, const RenderSettings *settings,
                   Error *error)
{
    if (!bench_picture_blank(picture, scene->screen.columns, scene->screen.rows, error))
        return false;
    RenderSettings wanted = *settings;
    wanted.linear = picture->rgb;
    return backend_render(backend, scene, &wanted, (BandSink){drop_band, NULL}, &picture->report, error);
}

void bench_picture_free(BenchPicture *picture)
{
    free(picture->rgb);
    picture->rgb = NULL;
}

void bench_picture_quantise(BenchPicture *picture)
{
    for (size_t i = 0; i < value_count(picture); i++)
        picture->rgb[i] = colour_to_byte(picture->rgb[i]) / 255.0;
}

static double clamped(double c)
{
    return fmin(fmax(c, 0), 1);
}

BenchDifference bench_difference(const BenchPicture *a, const BenchPicture *b)
{
    BenchDifference difference = {0};
    double squares = 0;
    size_t count = value_count(a), off = 0;
    for (size_t i = 0; i < count; i += 3) {
        double most = 0;
        for (size_t k = i; k < i + 3; k++) {
            double delta = fabs(clamped(a->rgb[k]) - clamped(b->rgb[k]));
            squares += delta * delta;
            most = fmax(most, delta);
        }
        difference.most = fmax(difference.most, most);
        off += most > 1 / 255.0;
    }
    difference.rmse = sqrt(squares / (double)count);
    difference.off = (double)(3 * off) / (double)count;
    return difference;
}
