/* Pictures with the reference tracer. A band of rows is shared out to threads, row by row; every row
 * is computed by one thread alone, so the bytes cannot depend on how many there are. */
#include "trace/reference_render.h"

#include "base/clock.h"
#include "base/parallel.h"
#include "trace/reference.h"
#include "trace/textbook.h"

#include <stdlib.h>
#include <string.h>

enum { BAND_ROWS = 32 };

/* A picture that will take longer than LONG_SECONDS is announced. To find out, one of so many pixels is tried, for at
 * most TRIAL_MS. */
static const double LONG_SECONDS = 3, TRIAL_MS = 100;
enum { TRIAL_SHARE = 256 };

typedef struct Band {
    const Scene *scene;
    const Accel *accel;
    unsigned char *rgb;
    const RenderSettings *settings;
    Region region;
    int first_row;        /* in the region */
    RenderReport *counts; /* one per thread: what it has counted in this band */
} Band;

static Vec3 exact_pixel(const Band *band, RenderReport *counts, int column, int row, unsigned char *rgb)
{
    const Tracer tracer = {.scene = band->scene, .accel = band->accel, .report = counts};
    Vec3 colour = reference_pixel(&tracer, column, row);
    rgb[0] = colour_to_byte(colour.x);
    rgb[1] = colour_to_byte(colour.y);
    rgb[2] = colour_to_byte(colour.z);
    return colour;
}

static Vec3 trace_pixel(const Band *band, RenderReport *counts, int column, int row, unsigned char *rgb)
{
    const RenderSettings *settings = band->settings;
    const Textbook textbook = {.scene = band->scene, .shift = settings->shift, .report = counts};
    if (settings->arithmetic == ARITHMETIC_EXACT)
        return exact_pixel(band, counts, column, row, rgb);
    return settings->precision == PRECISION_FLOAT ? textbook_pixel_float(&textbook, column, row, rgb)
                                                  : textbook_pixel(&textbook, column, row, rgb);
}

static void render_row(void *data, int band_row, int thread)
{
    const Band *band = data;
    double *linear = band->settings->linear; /* the whole region's, or NULL */
    size_t columns = (size_t)band->region.columns;
    int row = band->first_row + band_row;
    for (size_t column = 0; column < columns; column++) {
        unsigned char *rgb = band->rgb + ((size_t)band_row * columns + column) * 3;
        Vec3 colour =
            trace_pixel(band, &band->counts[thread], band->region.column + (int)column, band->region.row + row, rgb);
        if (linear)
            memcpy(linear + ((size_t)row * columns + column) * 3, &colour, sizeof colour);
    }
}

/* --- Single pixels --- */

static int greatest_divisor(int a, int b)
{
    return b == 0 ? a : greatest_divisor(b, a % b);
}

/* About the golden ratio of the whole. */
int reference_spread(int count)
{
    int step = (int)(0.6180339887 * count);
    while (step > 1 && greatest_divisor(count, step) > 1)
        step--;
    return step > 0 ? step : 1;
}

int reference_try(const Scene *scene, const Accel *accel, const RenderSettings *settings, int most, double most_ms,
                  RenderReport *report)
{
    const Band band = {.scene = scene, .accel = accel, .settings = settings};
    const Region region = render_region(settings, scene);
    int pixels = region.columns * region.rows, done = 0;
    int step = reference_spread(pixels);
    double start = clock_ms();
    memset(report, 0, sizeof *report);
    for (long long place = 0; done == 0 || (done < most && clock_ms() - start < most_ms); done++) {
        unsigned char rgb[3];
        trace_pixel(&band, report, region.column + (int)(place % region.columns),
                    region.row + (int)(place / region.columns), rgb);
        place = (place + step) % pixels;
    }
    report->trace_ms = clock_ms() - start;
    return done;
}

/* Tells the user how long the picture will take, where that is long. */
static void foresee(const Scene *scene, const Accel *accel, const RenderSettings *settings, int threads)
{
    const Notice *notice = &settings->notice;
    const Region region = render_region(settings, scene);
    int pixels = region.columns * region.rows;
    RenderReport trial;
    if (!notice->foresee)
        return;
    int tried = reference_try(scene, accel, settings, 1 + pixels / TRIAL_SHARE, TRIAL_MS, &trial);
    double seconds = trial.trace_ms / 1e3 * pixels / tried / threads;
    if (seconds > LONG_SECONDS)
        notice->foresee(notice->user, seconds);
}

/* --- Pictures --- */

static void add_counts(RenderReport *report, const RenderReport *counts)
{
    report->rays.primary += counts->rays.primary;
    report->rays.shadow += counts->rays.shadow;
    report->rays.reflection += counts->rays.reflection;
    report->box_tests += counts->box_tests;
    report->face_tests += counts->face_tests;
    report->refined_pixels += counts->refined_pixels;
    report->skipped[SKIP_LIGHT_BEHIND] += counts->skipped[SKIP_LIGHT_BEHIND];
}

/* Renders the band of so many rows, and adds its time and counts to the report. */
static void render_band(Band *band, int rows, RenderReport *report)
{
    double start = clock_ms();
    memset(band->counts, 0, (size_t)report->threads * sizeof *band->counts);
    parallel_for(report->threads, rows, render_row, band);
    for (int thread = 0; thread < report->threads; thread++)
        add_counts(report, &band->counts[thread]);
    report->trace_ms += clock_ms() - start;
}

/* Bands from the top, each handed to the sink when its rows are done. */
static bool render_bands(const Scene *scene, const Accel *accel, const RenderSettings *settings, BandSink sink,
                         RenderReport *report, Error *error)
{
    const Region region = render_region(settings, scene);
    Band band = {.scene = scene, .accel = accel, .settings = settings, .region = region};
    band.rgb = malloc((size_t)region.columns * 3 * BAND_ROWS);
    band.counts = malloc((size_t)report->threads * sizeof *band.counts);
    bool ok = (band.rgb && band.counts) || error_memory(error, "a band of the picture");
    for (int row = 0; ok && row < region.rows; row += BAND_ROWS) {
        int rows = region.rows - row < BAND_ROWS ? region.rows - row : BAND_ROWS;
        band.first_row = row;
        render_band(&band, rows, report);
        ok = sink.band(sink.user, row, rows, band.rgb, report, error);
    }
    free(band.rgb);
    free(band.counts);
    return ok;
}

/* The text has neither trees nor adaptive sampling. */
static bool check_textbook(const Scene *scene, AccelKind accel, Error *error)
{
    if (scene->adaptive && scene->grid > 1)
        return error_set(error, ERROR_USAGE, "textbook arithmetic has no adaptive sampling; use --sampling uniform:N");
    if (accel == ACCEL_KDTREE || accel == ACCEL_BVH || accel == ACCEL_LBVH)
        return error_set(error, ERROR_USAGE,
                         "the reference's textbook arithmetic has no tree; leave out --accel, or use --kernel plain");
    return true;
}

bool reference_render(const Scene *scene, const RenderSettings *settings, BandSink sink, RenderReport *report,
                      Error *error)
{
    memset(report, 0, sizeof *report);
    report->threads = parallel_threads(settings->threads);
    report->lanes = 1;
    strcpy(report->device, "reference");

    bool textbook = settings->arithmetic == ARITHMETIC_TEXTBOOK;
    if (textbook && !check_textbook(scene, settings->accel, error))
        return false;
    Accel accel;
    double start = clock_ms();
    bool ok = accel_build(&accel, scene, textbook ? ACCEL_NONE : settings->accel, settings->threads, error);
    report->build_ms = clock_ms() - start;
    report->accel = accel_name(&accel);
    if (ok)
        foresee(scene, &accel, settings, report->threads);
    ok = ok && render_bands(scene, &accel, settings, sink, report, error);
    accel_free(&accel);
    return ok;
}
