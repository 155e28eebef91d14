/* Time against error. To add a choice, see list_choices. */
#include "bench/bench_error.h"

#include "bench/bench_ground_truth.h"
#include "bench/bench_measure.h"
#include "bench/bench_scene.h"
#include "reader/scene_json.h"

#include <assert.h>
#include <stdio.h>
#include <stdlib.h>

static const int GRIDS[] = {1, 2, 3, 4, 6, 8, 12, 16};
enum { GRID_COUNT = sizeof GRIDS / sizeof GRIDS[0], BASE_GRID = 4, PIXELS = 160 * 120 };

#define LONGEST_MS 5000.0 /* a choice that is expected to take longer is left out */
#define REPEAT_MS 1000.0  /* one that takes longer is run once */
#define EQUAL 0.01

/* --- The choices --- */

static ErrorChoice *add(BenchError *result, ErrorSeries series, int grid)
{
    assert(result->choice_count < ERROR_MAX_CHOICES);
    ErrorChoice *choice = &result->choices[result->choice_count++];
    *choice = (ErrorChoice){.series = series, .grid = grid, .bounces = result->bounces, .better = -1};
    return choice;
}

/* Every grid; adaptive, there is nothing to refine in the first. */
static void add_grids(BenchError *result, ErrorSeries series, Backend backend, Precision precision, const char *what)
{
    bool adaptive = series >= SERIES_ADAPTIVE;
    for (int i = adaptive; i < GRID_COUNT; i++) {
        ErrorChoice *choice = add(result, series, GRIDS[i]);
        choice->backend = backend;
        choice->precision = precision;
        choice->adaptive = adaptive;
        snprintf(choice->name, sizeof choice->name, "%s, %s %d", what, adaptive ? "adaptive" : "grid", GRIDS[i]);
    }
}

/* The plain kernel has no adaptive sampling. */
static void add_plain(BenchError *result, ErrorSeries series, Arithmetic arithmetic, Precision precision)
{
    for (int grid = 1; grid <= 8; grid *= 2) {
        ErrorChoice *choice = add(result, series, grid);
        choice->kernel = KERNEL_PLAIN;
        choice->arithmetic = arithmetic;
        choice->precision = precision;
        snprintf(choice->name, sizeof choice->name, "plain/%s/%s, grid %d", render_arithmetics[arithmetic],
                 render_precisions[precision], grid);
    }
}

static void list_choices(BenchError *result, bool mirrors)
{
    add_grids(result, SERIES_FLOAT, BACKEND_OPENCL, PRECISION_FLOAT, "float");
    add_grids(result, SERIES_DOUBLE, BACKEND_OPENCL, PRECISION_DOUBLE, "double");
    add_grids(result, SERIES_REFERENCE, BACKEND_REFERENCE, PRECISION_DOUBLE, "reference");
    add_plain(result, SERIES_TEXTBOOK, ARITHMETIC_TEXTBOOK, PRECISION_FLOAT);
    add_plain(result, SERIES_TEXTBOOK_DOUBLE, ARITHMETIC_TEXTBOOK, PRECISION_DOUBLE);
    add_plain(result, SERIES_PLAIN, ARITHMETIC_EXACT, PRECISION_FLOAT);
    add_plain(result, SERIES_PLAIN_DOUBLE, ARITHMETIC_EXACT, PRECISION_DOUBLE);
    add_grids(result, SERIES_ADAPTIVE, BACKEND_OPENCL, PRECISION_FLOAT, "float");
    add_grids(result, SERIES_ADAPTIVE_DOUBLE, BACKEND_OPENCL, PRECISION_DOUBLE, "double");
    add_grids(result, SERIES_ADAPTIVE_REFERENCE, BACKEND_REFERENCE, PRECISION_DOUBLE, "reference");
    for (int bounces = 0; mirrors && bounces < result->bounces; bounces += bounces < 4 ? 1 : bounces / 2) {
        ErrorChoice *choice = add(result, SERIES_BOUNCES, BASE_GRID);
        choice->bounces = bounces;
        snprintf(choice->name, sizeof choice->name, "float, grid %d, %d bounce%s", BASE_GRID, bounces,
                 bounces == 1 ? "" : "s");
    }
    for (AccelKind accel = ACCEL_NONE; accel <= ACCEL_BVH; accel++) {
        ErrorChoice *choice = add(result, SERIES_ACCEL, BASE_GRID);
        choice->accel = accel;
        snprintf(choice->name, sizeof choice->name, "float, grid %d, accel %s", BASE_GRID, render_accels[accel]);
    }
}

/* --- Measuring --- */

static bool trace(const ErrorChoice *choice, const Scene *scene, const BenchPlan *plan, BenchPicture *picture,
                  Error *error)
{
    Scene changed = *scene;
    RenderSettings settings = plan->settings;
    changed.grid = choice->grid;
    changed.adaptive = choice->adaptive;
    changed.shading.max_bounces = choice->bounces;
    settings.precision = choice->precision;
    settings.kernel = choice->kernel;
    settings.arithmetic = choice->arithmetic;
    if (choice->accel != ACCEL_AUTO)
        settings.accel = choice->accel;
    return bench_picture(picture, &changed, choice->backend, &settings, error);
}

/* What a choice should take, from the coarser one of its series before it; 0 where nothing is known. */
static double expected_ms(const BenchError *result, int index)
{
    const ErrorChoice *choice = &result->choices[index], *before = choice - 1;
    if (index == 0 || before->series != choice->series || before->grid >= choice->grid)
        return 0;
    return before->ms * choice->grid * choice->grid / (before->grid * before->grid);
}

static bool measure_error(BenchError *result, int index, const Scene *scene, const BenchGroundTruth *truth,
                          const BenchPlan *plan, Error *error)
{
    ErrorChoice *choice = &result->choices[index];
    BenchPicture picture = {0};
    choice->ms = expected_ms(result, index);
    if (choice->ms > LONGEST_MS)
        return true;
    bool ok = trace(choice, scene, plan, &picture, error);
    if (ok) {
        choice->runs = 1;
        choice->ms = picture.report.trace_ms;
        choice->rays = picture.report.rays;
        choice->error = bench_difference(&picture, &truth->picture);
    }
    bench_picture_free(&picture);
    return ok;
}

typedef double Times[BENCH_MAX_REPEATS];

static bool measure_times(BenchError *result, const Scene *scene, const BenchPlan *plan, Times *times, Error *error)
{
    for (int round = 0; round < plan->repeats; round++)
        for (int i = 0; i < result->choice_count; i++) {
            ErrorChoice *choice = &result->choices[i];
            BenchPicture picture = {0};
            if (choice->runs == 0 || choice->ms > REPEAT_MS)
                continue;
            bool ok = trace(choice, scene, plan, &picture, error);
            times[i][round] = picture.report.trace_ms;
            bench_picture_free(&picture);
            if (!ok)
                return false;
        }
    for (int i = 0; i < result->choice_count; i++)
        if (result->choices[i].runs > 0 && result->choices[i].ms <= REPEAT_MS) {
            result->choices[i].ms = bench_median(times[i], plan->repeats);
            result->choices[i].runs = plan->repeats;
        }
    return true;
}

/* Errors within EQUAL of one another count as equal, so that a choice is not on the front for its last digits. */
static bool is_better(const ErrorChoice *a, const ErrorChoice *b)
{
    if (a->runs == 0 || b->runs == 0)
        return false;
    return (a->ms < b->ms && a->error.rmse <= b->error.rmse * (1 + EQUAL)) ||
           (a->ms == b->ms && a->error.rmse < b->error.rmse);
}

/* Finds the Pareto front; a dominated choice names the most
 * accurate of those that are better, and of them the fastest. */
static void find_front(BenchError *result)
{
    for (int i = 0; i < result->choice_count; i++) {
        const ErrorChoice *best = NULL;
        for (int k = 0; k < result->choice_count; k++) {
            const ErrorChoice *other = &result->choices[k];
            if (is_better(other, &result->choices[i]) &&
                (!best || other->error.rmse < best->error.rmse * (1 - EQUAL) ||
                 (other->error.rmse <= best->error.rmse * (1 + EQUAL) && other->ms < best->ms)))
                best = other;
        }
        result->choices[i].better = best ? (int)(best - result->choices) : -1;
    }
}

/* --- All of it --- */

/* Does any ray leave a mirror? */
static bool reflects(const Scene *scene)
{
    for (int i = 0; i < scene->face_count; i++)
        if (scene->materials[scene->faces[i].material].reflection > 0)
            return true;
    return false;
}

static bool measure(BenchError *result, const Scene *scene, const BenchPlan *plan, Times *times, Error *error)
{
    BenchGroundTruth truth;
    bool ok = bench_ground_truth(&truth, scene, &plan->settings, error);
    result->truth_error = truth.own_error;
    result->truth_check = truth.check;
    for (int i = 0; i < result->choice_count && ok; i++)
        ok = measure_error(result, i, scene, &truth, plan, error);
    ok = ok && measure_times(result, scene, plan, times, error) &&
         bench_error_find_causes(&result->causes, scene, &truth, plan, error);
    bench_ground_truth_free(&truth);
    if (ok)
        find_front(result);
    return ok;
}

/* The scene in the size and with the grid that are wanted. */
static void settle(BenchError *result, Scene *scene, const BenchScene *wanted)
{
    if (wanted->columns == 0)
        bench_scene_fit(&result->scene, &scene->screen, PIXELS);
    if (wanted->grid == 0)
        result->scene.grid = scene->grid;
    scene->screen.columns = result->scene.columns;
    scene->screen.rows = result->scene.rows;
    scene->adaptive = scene->adaptive && scene->grid == result->scene.grid;
    scene->grid = result->scene.grid;
    result->adaptive = scene->adaptive;
    result->faces = scene->face_count;
    result->bounces = scene->shading.max_bounces;
}

static bool load(BenchError *result, Scene *scene, const BenchScene *wanted, const BenchPlan *plan, Error *error)
{
    *result = (BenchError){.scene = *wanted};
    if (!scene_load(scene, wanted->path, error))
        return false;
    bench_tell(scene, plan);
    if (bench_error_arithmetic(&result->arithmetic, scene, wanted, plan, error))
        return true;
    scene_free(scene);
    return false;
}

bool bench_error(BenchError *result, const BenchScene *wanted, const BenchPlan *plan, Error *error)
{
    Scene scene;
    if (!load(result, &scene, wanted, plan, error))
        return false;
    settle(result, &scene, wanted);
    list_choices(result, reflects(&scene));
    Times *times = malloc(ERROR_MAX_CHOICES * sizeof *times);
    bool ok = times ? measure(result, &scene, plan, times, error) : error_memory(error, "the times");
    free(times);
    scene_free(&scene);
    return ok;
}

bool bench_error_arithmetic_only(BenchError *result, const BenchScene *wanted, const BenchPlan *plan, Error *error)
{
    Scene scene;
    if (!load(result, &scene, wanted, plan, error))
        return false;
    result->arithmetic_only = true;
    result->faces = scene.face_count;
    scene_free(&scene);
    return true;
}
