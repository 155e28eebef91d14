/* rectray compare: how far two pictures of the same size differ, in units of the 8-bit values. Peak signal-to-noise
 * ratio: 10 log10(255^2 / mean squared error), the mean taken over all pixels and channels. */
#include "command/command.h"
#include "picture/heat.h"
#include "picture/image.h"
#include "picture/image_linear.h"

#include <inttypes.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* What the colours of a heatmap stand for: heat_of_difference at these values. */
#define HEAT_SCALE "black 0, violet 1, pink 8, orange 30, cream 100, white 255; by the logarithm between"

typedef struct Difference {
    int max[3];       /* per channel */
    uint64_t sum[3];  /* of the absolute differences */
    uint64_t squares; /* over all channels */
    uint64_t pixels, differing;
} Difference;

static int absolute(int a)
{
    return a < 0 ? -a : a;
}

static bool is_stdout(const char *path)
{
    return path && strcmp(path, "-") == 0;
}

static int largest(const Difference *difference)
{
    int max = 0;
    for (int channel = 0; channel < 3; channel++)
        max = difference->max[channel] > max ? difference->max[channel] : max;
    return max;
}

static Difference measure(const Image *a, const Image *b)
{
    Difference difference = {.pixels = (uint64_t)a->columns * (uint64_t)a->rows};
    for (uint64_t pixel = 0; pixel < difference.pixels; pixel++) {
        bool differs = false;
        for (int channel = 0; channel < 3; channel++) {
            uint64_t at = 3 * pixel + (uint64_t)channel;
            int delta = absolute(a->rgb[at] - b->rgb[at]);
            differs = differs || delta > 0;
            difference.max[channel] = delta > difference.max[channel] ? delta : difference.max[channel];
            difference.sum[channel] += (uint64_t)delta;
            difference.squares += (uint64_t)(delta * delta);
        }
        difference.differing += differs;
    }
    return difference;
}

static void print_difference(FILE *out, const Difference *difference)
{
    static const char *const channels[] = {"red", "green", "blue"};
    double pixels = (double)difference->pixels;
    double squares = (double)difference->squares / (3 * pixels);
    fprintf(out, "%-10s%6s  %s\n", "", "max", "mean");
    for (int channel = 0; channel < 3; channel++)
        fprintf(out, "%-10s%6d  %.6f\n", channels[channel], difference->max[channel],
                (double)difference->sum[channel] / pixels);
    fprintf(out, "%-10s%.6f\n", "rmse", sqrt(squares));
    if (squares > 0)
        fprintf(out, "%-10s%.2f dB\n", "psnr", 10 * log10(255.0 * 255.0 / squares));
    else
        fprintf(out, "%-10sinfinite\n", "psnr");
    fprintf(out, "%-10s%" PRIu64 " of %" PRIu64 " pixels (%.4f %%)\n", "differing", difference->differing,
            difference->pixels, 100 * (double)difference->differing / pixels);
}

/* The absolute differences, stretched so that the largest becomes 255: a difference of 1 would be invisible. */
static void make_difference_picture(Image *a, const Image *b, int max)
{
    size_t bytes = (size_t)a->columns * (size_t)a->rows * 3;
    for (size_t i = 0; i < bytes && max > 0; i++)
        a->rgb[i] = (unsigned char)(absolute(a->rgb[i] - b->rgb[i]) * 255 / max);
    for (size_t i = 0; i < bytes && max == 0; i++)
        a->rgb[i] = 0;
}

static bool write_heatmap(const Image *a, const Image *b, const char *path, Error *error)
{
    Image map = {a->columns, a->rows, NULL};
    size_t bytes = (size_t)a->columns * (size_t)a->rows * 3;
    map.rgb = malloc(bytes);
    if (!map.rgb)
        return error_memory(error, "the heatmap");
    for (size_t i = 0; i < bytes; i += 3) {
        int most = 0;
        for (size_t channel = 0; channel < 3; channel++) {
            int delta = absolute(a->rgb[i + channel] - b->rgb[i + channel]);
            most = delta > most ? delta : most;
        }
        heat_colour(heat_of_difference(most), map.rgb + i);
    }
    bool done = image_write(&map, path, error);
    image_free(&map);
    return done;
}

/* Overwrites picture a with the picture of the differences where that is asked for. */
static bool compare(Image *a, const Image *b, const Options *options, Error *error)
{
    const char *const *names = options->operands;
    if (a->columns != b->columns || a->rows != b->rows)
        return error_set(error, ERROR_INPUT, "%s has %d x %d pixels, %s %d x %d: they cannot be compared", names[0],
                         a->columns, a->rows, names[1], b->columns, b->rows);
    Difference difference = measure(a, b);
    int max = largest(&difference);
    bool to_stdout = is_stdout(options->output) || is_stdout(options->heatmap);
    if (options->heatmap && !write_heatmap(a, b, options->heatmap, error))
        return false;
    if (options->output) {
        make_difference_picture(a, b, max);
        if (!image_write(a, options->output, error))
            return false;
    }
    if (!options->quiet) {
        print_difference(to_stdout ? stderr : stdout, &difference);
        if (options->heatmap)
            fputs("heatmap   " HEAT_SCALE "\n", to_stdout ? stderr : stdout);
    }
    if (max > options->tolerance)
        return error_set(error, ERROR_INPUT, "%s and %s differ by up to %d of 255, %d is tolerated", names[0], names[1],
                         max, options->tolerance);
    return true;
}

/* --- Linear colours --- */

/* The root of the mean squared difference, over all values, and the largest difference. */
static void print_linear(const LinearImage *a, const LinearImage *b)
{
    size_t values = (size_t)a->columns * (size_t)a->rows * 3, differing = 0;
    double squares = 0, most = 0;
    for (size_t i = 0; i < values; i++) {
        double delta = fabs((double)a->rgb[i] - (double)b->rgb[i]);
        squares += delta * delta;
        most = delta > most ? delta : most;
        differing += !(delta == 0);
    }
    printf("%-10s%.9g\n%-10s%.9g\n%-10s%zu of %zu values\n", "rmse", sqrt(squares / (double)values), "max", most,
           "differing", differing, values);
}

static bool compare_linear(const LinearImage *a, const LinearImage *b, const Options *options, Error *error)
{
    const char *const *names = options->operands;
    if (a->columns != b->columns || a->rows != b->rows)
        return error_set(error, ERROR_INPUT, "%s has %d x %d pixels, %s %d x %d: they cannot be compared", names[0],
                         a->columns, a->rows, names[1], b->columns, b->rows);
    if (!options->quiet)
        print_linear(a, b);
    size_t bytes = (size_t)a->columns * (size_t)a->rows * 3 * sizeof *a->rgb;
    return memcmp(a->rgb, b->rgb, bytes) == 0 || error_set(error, ERROR_INPUT, "%s and %s differ", names[0], names[1]);
}

/* Two PFM. They are equal or they are not: a tolerance and pictures of differences are of 8 bits. */
static bool compare_pfm(const Options *options, Error *error)
{
    const char *const *names = options->operands;
    LinearImage a = {0}, b = {0};
    for (int i = 0; i < 2; i++)
        if (!image_is_pfm(names[i]))
            return error_set(error, ERROR_INPUT, "%s is a PFM, of linear colours, and %s is not; compare it with a PFM",
                             names[1 - i], names[i]);
    if (options->output || options->heatmap || options->tolerance > 0)
        return error_set(error, ERROR_USAGE, "--output, --heatmap and --tolerance are for pictures of 8 bits, not PFM");
    bool done = image_linear_read(&a, names[0], error) && image_linear_read(&b, names[1], error) &&
                compare_linear(&a, &b, options, error);
    image_linear_free(&a);
    image_linear_free(&b);
    return done;
}

bool command_compare(const Options *options, Error *error)
{
    if (image_is_pfm(options->operands[0]) || image_is_pfm(options->operands[1]))
        return compare_pfm(options, error);
    if (options->output && options->heatmap && strcmp(options->output, options->heatmap) == 0)
        return error_set(error, ERROR_USAGE, "--output and --heatmap are two pictures; both cannot be %s",
                         options->output);
    Image a = {0}, b = {0};
    bool done = image_read(&a, options->operands[0], error) && image_read(&b, options->operands[1], error) &&
                compare(&a, &b, options, error);
    image_free(&a);
    image_free(&b);
    return done;
}
