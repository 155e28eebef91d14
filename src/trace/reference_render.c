/* Whole pictures with the reference tracer. A band of rows is shared out to threads, row by row; every row
 * is computed by one thread alone, so the bytes cannot depend on how many there are. */
#include "trace/reference_render.h"

#include "base/clock.h"
#include "base/parallel.h"
#include "trace/reference.h"

#include <pthread.h>
#include <stdlib.h>
#include <string.h>

enum { BAND_ROWS = 32 };

typedef struct Band {
    const Scene *scene;
    const Accel *accel;
    unsigned char *rgb;
    double *linear; /* the whole picture's, or NULL */
    int first_row, row_count;
    int next_row; /* guarded by the lock, as is the report */
    pthread_mutex_t lock;
    RenderReport *report;
} Band;

static int take_row(Band *band)
{
    pthread_mutex_lock(&band->lock);
    int row = band->next_row < band->row_count ? band->next_row++ : -1;
    pthread_mutex_unlock(&band->lock);
    return row;
}

static void add_counts(Band *band, const RenderReport *counts)
{
    pthread_mutex_lock(&band->lock);
    band->report->rays.primary += counts->rays.primary;
    band->report->rays.shadow += counts->rays.shadow;
    band->report->rays.reflection += counts->rays.reflection;
    band->report->box_tests += counts->box_tests;
    band->report->face_tests += counts->face_tests;
    band->report->refined_pixels += counts->refined_pixels;
    band->report->skipped[SKIP_LIGHT_BEHIND] += counts->skipped[SKIP_LIGHT_BEHIND];
    pthread_mutex_unlock(&band->lock);
}

static void put_pixel(const Band *band, int column, int row, Vec3 colour)
{
    size_t at = ((size_t)row * (size_t)band->scene->screen.columns + (size_t)column) * 3;
    const double rgb[3] = {colour.x, colour.y, colour.z};
    for (size_t i = 0; i < 3; i++)
        band->rgb[at + i] = colour_to_byte(rgb[i]);
    if (band->linear)
        memcpy(band->linear + (size_t)band->first_row * (size_t)band->scene->screen.columns * 3 + at, rgb, sizeof rgb);
}

static void render_rows(void *argument)
{
    Band *band = argument;
    RenderReport counts = {0};
    Tracer tracer = {.scene = band->scene, .accel = band->accel, .report = &counts};
    int columns = band->scene->screen.columns;
    for (int row; (row = take_row(band)) >= 0;)
        for (int column = 0; column < columns; column++)
            put_pixel(band, column, row, reference_pixel(&tracer, column, band->first_row + row));
    add_counts(band, &counts);
}

/* Bands from the top, each handed to the sink when its rows are done. */
static bool render_bands(const Scene *scene, const Accel *accel, double *linear, BandSink sink, RenderReport *report,
                         Error *error)
{
    size_t row_bytes = (size_t)scene->screen.columns * 3;
    unsigned char *rgb = malloc(row_bytes * BAND_ROWS);
    if (!rgb)
        return error_memory(error, "a band of the picture");
    bool ok = true;
    for (int row = 0; ok && row < scene->screen.rows; row += BAND_ROWS) {
        int rows = scene->screen.rows - row < BAND_ROWS ? scene->screen.rows - row : BAND_ROWS;
        Band band = {.scene = scene,
                     .accel = accel,
                     .rgb = rgb,
                     .linear = linear,
                     .first_row = row,
                     .row_count = rows,
                     .report = report};
        double start = clock_ms();
        pthread_mutex_init(&band.lock, NULL);
        parallel_run(report->threads, render_rows, &band);
        pthread_mutex_destroy(&band.lock);
        report->trace_ms += clock_ms() - start;
        ok = sink.band(sink.user, row, rows, rgb, report, error);
    }
    free(rgb);
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
