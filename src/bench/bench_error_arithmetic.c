/* What exact arithmetic costs and what it buys. */
#include "bench/bench_error_arithmetic.h"

#include "bench/bench_measure.h"
#include "bench/bench_scene.h"

#include <stdio.h>

enum { PIXELS = 320 * 240, NEARLY = 80000 }; /* a scene of nearly so many pixels keeps its own size */

#define REPEAT_MS 1000.0 /* what takes longer is run once */

ArithmeticName bench_arithmetic_name(const ArithmeticRow *row)
{
    ArithmeticName name;
    snprintf(name.text, sizeof name.text, "%s/%s/%s", render_kernels[row->kernel], render_arithmetics[row->arithmetic],
             render_precisions[row->precision]);
    return name;
}

static void list_rows(ErrorArithmetic *result)
{
    static const ArithmeticRow rows[ARITHMETIC_ROWS] = {
        [ROW_TEXTBOOK_FLOAT] = {.kernel = KERNEL_PLAIN,
                                .arithmetic = ARITHMETIC_TEXTBOOK,
                                .precision = PRECISION_FLOAT},
        [ROW_EXACT_FLOAT] = {.kernel = KERNEL_PLAIN, .arithmetic = ARITHMETIC_EXACT, .precision = PRECISION_FLOAT},
        [ROW_TEXTBOOK_DOUBLE] = {.kernel = KERNEL_PLAIN,
                                 .arithmetic = ARITHMETIC_TEXTBOOK,
                                 .precision = PRECISION_DOUBLE},
        [ROW_EXACT_DOUBLE] = {.kernel = KERNEL_PLAIN, .arithmetic = ARITHMETIC_EXACT, .precision = PRECISION_DOUBLE},
        [ROW_PACKET_FLOAT] = {.kernel = KERNEL_PACKET, .arithmetic = ARITHMETIC_EXACT, .precision = PRECISION_FLOAT},
        [ROW_PACKET_DOUBLE] = {.kernel = KERNEL_PACKET, .arithmetic = ARITHMETIC_EXACT, .precision = PRECISION_DOUBLE},
    };
    for (int i = 0; i < ARITHMETIC_ROWS; i++)
        result->row[i] = rows[i];
}

static RenderSettings settings_of(const ArithmeticRow *row, const BenchPlan *plan)
{
    RenderSettings settings = plan->settings;
    settings.kernel = row->kernel;
    settings.arithmetic = row->arithmetic;
    settings.precision = row->precision;
    return settings;
}

static bool trace(ArithmeticRow *row, const Scene *scene, const BenchPlan *plan, const BenchPicture *truth, double *ms,
                  Error *error)
{
    BenchPicture picture = {0};
    RenderSettings settings = settings_of(row, plan);
    bool ok = bench_picture(&picture, scene, BACKEND_OPENCL, &settings, error);
    if (ok) {
        *ms = picture.report.trace_ms;
        row->error = bench_difference(&picture, truth);
    }
    bench_picture_free(&picture);
    return ok;
}

/* Each row once a round, so that all see the same load; the first picture of each warms up. */
static bool measure(ErrorArithmetic *result, const Scene *scene, const BenchPlan *plan, const BenchPicture *truth,
                    Error *error)
{
    double times[ARITHMETIC_ROWS][BENCH_MAX_REPEATS];
    bool repeated[ARITHMETIC_ROWS];
    for (int i = 0; i < ARITHMETIC_ROWS; i++) {
        ArithmeticRow *row = &result->row[i];
        if (!trace(row, scene, plan, truth, &row->ms, error))
            return false;
        row->runs = 1;
        repeated[i] = row->ms <= REPEAT_MS;
    }
    for (int round = 0; round < plan->repeats; round++)
        for (int i = 0; i < ARITHMETIC_ROWS; i++)
            if (repeated[i] && !trace(&result->row[i], scene, plan, truth, &times[i][round], error))
                return false;
    for (int i = 0; i < ARITHMETIC_ROWS; i++)
        if (repeated[i]) {
            result->row[i].ms = bench_median(times[i], plan->repeats);
            result->row[i].runs = plan->repeats;
        }
    return true;
}

bool bench_error_arithmetic(ErrorArithmetic *result, const Scene *scene, const BenchScene *wanted,
                            const BenchPlan *plan, Error *error)
{
    Scene single = *scene;
    BenchScene size = *wanted;
    BenchPicture truth = {0};
    RenderSettings exact = plan->settings;
    bool fits = (long)scene->screen.columns * scene->screen.rows <= NEARLY;
    if (size.columns == 0 && fits) {
        size.columns = scene->screen.columns;
        size.rows = scene->screen.rows;
    } else if (size.columns == 0) {
        bench_scene_fit(&size, &scene->screen, PIXELS);
    }
    single.screen.columns = result->columns = size.columns;
    single.screen.rows = result->rows = size.rows;
    single.grid = 1;
    single.adaptive = false;
    list_rows(result);
    bool ok = bench_picture(&truth, &single, BACKEND_REFERENCE, &exact, error) &&
              measure(result, &single, plan, &truth, error);
    bench_picture_free(&truth);
    return ok;
}
