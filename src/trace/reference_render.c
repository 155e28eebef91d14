/* Whole pictures with the reference tracer. A band of rows is shared out to threads, row by row; every row
 * is computed by one thread alone, so the bytes cannot depend on how many there are. */
#include "trace/reference_render.h"

#include "base/clock.h"
#include "base/parallel.h"
#include "trace/reference.h"

#include <stdlib.h>
#include <string.h>

enum { BAND_ROWS = 32 };

typedef struct Band {
    const Scene *scene;
    const Accel *accel;
    unsigned char *rgb;
    double *linear; /* the whole picture's, or NULL */
    int first_row;
    RenderReport *counts; /* one per thread: what it has counted in this band */
} Band;

static void put_pixel(const Band *band, int column, int row, Vec3 colour)
{
    size_t at = ((size_t)row * (size_t)band->scene->screen.columns + (size_t)column) * 3;
    const double rgb[3] = {colour.x, colour.y, colour.z};
    for (size_t i = 0; i < 3; i++)
        band->rgb[at + i] = colour_to_byte(rgb[i]);
    if (band->linear)
        memcpy(band->linear + (size_t)band->first_row * (size_t)band->scene->screen.columns * 3 + at, rgb, sizeof rgb);
}

static void render_row(void *data, int row, int thread)
{
    const Band *band = data;
    Tracer tracer = {.scene = band->scene, .accel = band->accel, .report = &band->counts[thread]};
    for (int column = 0; column < band->scene->screen.columns; column++)
        put_pixel(band, column, row, reference_pixel(&tracer, column, band->first_row + row));
}

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
static bool render_bands(const Scene *scene, const Accel *accel, double *linear, BandSink sink, RenderReport *report,
                         Error *error)
{
    Band band = {.scene = scene, .accel = accel, .linear = linear};
    band.rgb = malloc((size_t)scene->screen.columns * 3 * BAND_ROWS);
    band.counts = malloc((size_t)report->threads * sizeof *band.counts);
    bool ok = (band.rgb && band.counts) || error_memory(error, "a band of the picture");
    for (int row = 0; ok && row < scene->screen.rows; row += BAND_ROWS) {
        int rows = scene->screen.rows - row < BAND_ROWS ? scene->screen.rows - row : BAND_ROWS;
        band.first_row = row;
        render_band(&band, rows, report);
        ok = sink.band(sink.user, row, rows, band.rgb, report, error);
    }
    free(band.rgb);
    free(band.counts);
    return ok;
}

bool reference_render(const Scene *scene, const RenderSettings *settings, BandSink sink, RenderReport *report,
                      Error *error)
{
    memset(report, 0, sizeof *report);
    report->threads = parallel_threads(settings->threads);
    report->lanes = 1;
    strcpy(report->device, "reference");

    Accel accel;
    double start = clock_ms();
    bool ok = accel_build(&accel, scene, settings->accel, settings->threads, error);
    report->build_ms = clock_ms() - start;
    report->accel = accel.kind;
    ok = ok && render_bands(scene, &accel, settings->linear, sink, report, error);
    accel_free(&accel);
    return ok;
}
