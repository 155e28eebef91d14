/* Pictures that are timed, and the median of the times. */
#include "bench/bench_measure.h"

#include <stdlib.h>
#include <string.h>

static int by_size(const void *a, const void *b)
{
    double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

double bench_median(double *times, int count)
{
    /* cppcheck-suppress uninitvar ; all are set, for a plan has 1 to 99 repeats */
    qsort(times, (size_t)count, sizeof *times, by_size);
    return count == 0 ? 0 : (times[(count - 1) / 2] + times[count / 2]) / 2;
}

/* Copies a band into the picture `user`, or drops it where there is none. */
static bool keep_band(void *user, int first_row, int rows, const unsigned char *rgb, const RenderReport *so_far,
                      Error *error)
{
    (void)so_far, (void)error;
    Image *picture = user;
    if (picture) {
        size_t row_bytes = (size_t)picture->columns * 3;
        memcpy(picture->rgb + (size_t)first_row * row_bytes, rgb, (size_t)rows * row_bytes);
    }
    return true;
}

BandSink bench_sink(Image *picture)
{
    return (BandSink){keep_band, picture};
}

bool bench_trace_once(OpenclScene *held, Image *picture, RenderReport *report, Error *error)
{
    return opencl_picture(held, bench_sink(picture), report, error);
}
