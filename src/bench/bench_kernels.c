/* The ladder of kernels. To add a row, see list_rows. */
#include "bench/bench_kernels.h"

#include "bench/bench_measure.h"
#include "bench/bench_scene.h"
#include "opencl/backend.h"
#include "reader/scene_json.h"

#include <assert.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { PIXELS = 320 * 240 };

#define REPEAT_MS 1000.0 /* a row that takes longer is run once */
#define MOST_TESTS 2e9   /* a row without a tree that tests more faces is left out */

/* --- The rows --- */

static KernelRow *add(BenchKernels *result, KernelRow row, const char *name)
{
    assert(result->row_count < KERNELS_MAX_ROWS);
    KernelRow *added = &result->rows[result->row_count++];
    *added = row;
    snprintf(added->name, sizeof added->name, "%s", name);
    return added;
}

/* Packets of 1, 4, 8 and 16 rays; then those whose tiles can be classified, each against the same without. */
static void add_packets(BenchKernels *result)
{
    static const int lanes[] = {1, 4, 8, 16};
    KernelRow row = {.backend = BACKEND_OPENCL, .kernel = KERNEL_PACKET, .accel = ACCEL_BVH};
    int first = result->row_count;
    char name[64];
    for (int i = 0; i < 4; i++) {
        row.against = result->row_count - 1;
        row.lanes = lanes[i];
        snprintf(name, sizeof name, "packets, %d lane%s, bvh", lanes[i], lanes[i] == 1 ? "" : "s");
        add(result, row, name);
    }
    row.tiles = true;
    for (int i = 1; i < 4; i++) {
        row.against = first + i;
        row.lanes = lanes[i];
        snprintf(name, sizeof name, "packets, %d lanes, bvh, classes of tiles", lanes[i]);
        add(result, row, name);
    }
}

static void list_rows(BenchKernels *result)
{
    KernelRow row = {.backend = BACKEND_REFERENCE, .accel = ACCEL_NONE, .against = -1, .one_thread = true};
    add(result, row, "reference, no tree, one thread");
    row.one_thread = false;
    row.against = 0;
    add(result, row, "reference, no tree, all threads");
    row = (KernelRow){.backend = BACKEND_OPENCL, .kernel = KERNEL_PLAIN, .lanes = 1};
    static const char *const names[] = {
        [ACCEL_NONE] = "plain, no tree", [ACCEL_KDTREE] = "plain, kdtree", [ACCEL_BVH] = "plain, bvh"};
    for (AccelKind accel = ACCEL_NONE; accel <= ACCEL_BVH; accel++) {
        row.accel = accel;
        row.against = result->row_count - 1;
        add(result, row, names[accel]);
    }
    add_packets(result);
}

/* --- Measuring --- */

typedef double Times[BENCH_MAX_REPEATS];

/* What a measurement needs besides its result. A row of the OpenCL backend holds its scene on the device. */
typedef struct Work {
    const Scene *scene;
    const BenchPlan *plan;
    OpenclScene *held[KERNELS_MAX_ROWS];
    Image picture, truth; /* the last row's, and the reference's */
    Times times[KERNELS_MAX_ROWS];
} Work;

static RenderSettings settings_of(const KernelRow *row, const BenchPlan *plan)
{
    RenderSettings settings = plan->settings;
    settings.kernel = row->kernel;
    settings.accel = row->accel;
    settings.lanes = row->kernel == KERNEL_PACKET ? row->lanes : 0;
    if (row->one_thread)
        settings.threads = 1;
    if (!row->tiles)
        settings.no_skip |= 1u << SKIP_WHOLE_TILE;
    return settings;
}

static bool trace(Work *work, const KernelRow *row, int index, RenderReport *report, Error *error)
{
    RenderSettings settings = settings_of(row, work->plan);
    if (row->backend == BACKEND_REFERENCE)
        return backend_render(row->backend, work->scene, &settings, bench_sink(&work->picture), report, error);
    if (!work->held[index])
        work->held[index] = opencl_hold(work->scene, &settings, error);
    return work->held[index] && bench_trace_once(work->held[index], &work->picture, report, error);
}

static int channels_apart(const unsigned char *a, const unsigned char *b)
{
    int most = 0;
    for (int i = 0; i < 3; i++)
        most = abs(a[i] - b[i]) > most ? abs(a[i] - b[i]) : most;
    return most;
}

static void compare(KernelRow *row, const Image *picture, const Image *truth)
{
    size_t pixels = (size_t)truth->columns * (size_t)truth->rows;
    for (size_t i = 0; i < pixels; i++) {
        int apart = channels_apart(picture->rgb + 3 * i, truth->rgb + 3 * i);
        row->differing += apart > 0;
        row->off += apart > 1;
    }
}

/* A primary ray and a shadow ray of each pixel meet all faces. */
static bool takes_too_long(const KernelRow *row, const Scene *scene)
{
    double pixels = (double)scene->screen.columns * scene->screen.rows * scene->grid * scene->grid;
    return row->accel == ACCEL_NONE && 2 * pixels * scene->face_count > MOST_TESTS;
}

/* The first picture of a row warms up; it is also the one that is looked at. */
static bool measure_first(Work *work, KernelRow *row, int index, Error *error)
{
    RenderReport report;
    if (takes_too_long(row, work->scene))
        return true;
    if (!trace(work, row, index, &report, error))
        return false;
    row->runs = 1;
    row->ms = report.trace_ms;
    row->box_tests = report.box_tests;
    row->face_tests = report.face_tests;
    compare(row, &work->picture, &work->truth);
    return true;
}

static bool is_repeated(const KernelRow *row)
{
    return row->runs > 0 && row->ms <= REPEAT_MS;
}

static bool measure_times(BenchKernels *result, Work *work, Error *error)
{
    int repeats = work->plan->repeats;
    bool repeated[KERNELS_MAX_ROWS] = {false};
    for (int i = 0; i < result->row_count; i++)
        repeated[i] = is_repeated(&result->rows[i]);
    for (int round = 0; round < repeats; round++)
        for (int i = 0; i < result->row_count; i++) {
            RenderReport report;
            if (!repeated[i])
                continue;
            if (!trace(work, &result->rows[i], i, &report, error))
                return false;
            work->times[i][round] = report.trace_ms;
        }
    for (int i = 0; i < result->row_count; i++)
        if (repeated[i]) {
            result->rows[i].ms = bench_median(work->times[i], repeats);
            result->rows[i].runs = repeats;
        }
    return true;
}

/* The reference's picture, the sooner for its tree. */
static bool make_truth(Work *work, Error *error)
{
    const Screen *screen = &work->scene->screen;
    size_t bytes = (size_t)screen->columns * (size_t)screen->rows * 3;
    work->picture = (Image){screen->columns, screen->rows, malloc(bytes)};
    work->truth = (Image){screen->columns, screen->rows, malloc(bytes)};
    RenderSettings settings = {.accel = ACCEL_BVH, .threads = work->plan->settings.threads};
    RenderReport report;
    return ((work->picture.rgb && work->truth.rgb) || error_memory(error, "two pictures")) &&
           backend_render(BACKEND_REFERENCE, work->scene, &settings, bench_sink(&work->truth), &report, error);
}

static bool measure(BenchKernels *result, Work *work, Error *error)
{
    bool ok = make_truth(work, error);
    for (int i = 0; i < result->row_count && ok; i++)
        ok = measure_first(work, &result->rows[i], i, error);
    return ok && measure_times(result, work, error);
}

static bool measure_scene(BenchKernels *result, const Scene *scene, const BenchPlan *plan, Error *error)
{
    Work *work = calloc(1, sizeof *work);
    if (!work)
        return error_memory(error, "the times");
    work->scene = scene;
    work->plan = plan;
    bool ok = measure(result, work, error);
    for (int i = 0; i < KERNELS_MAX_ROWS; i++)
        opencl_release(work->held[i]);
    image_free(&work->picture);
    image_free(&work->truth);
    free(work);
    return ok;
}

bool bench_kernels(BenchKernels *result, const BenchScene *wanted, const BenchPlan *plan, Error *error)
{
    Scene scene;
    *result = (BenchKernels){.scene = *wanted};
    if (!scene_load(&scene, wanted->path, error))
        return false;
    bench_tell(&scene, plan);
    if (wanted->columns == 0)
        bench_scene_fit(&result->scene, &scene.screen, PIXELS);
    if (wanted->grid == 0)
        result->scene.grid = 1;
    scene.screen.columns = result->scene.columns;
    scene.screen.rows = result->scene.rows;
    scene.adaptive = false; /* the plain kernel has no adaptive sampling */
    scene.grid = result->scene.grid;
    result->faces = scene.face_count;
    list_rows(result);
    bool ok = measure_scene(result, &scene, plan, error);
    scene_free(&scene);
    return ok;
}

double bench_kernels_ratio(const BenchKernels *result, int row)
{
    const KernelRow *own = &result->rows[row];
    if (own->against < 0 || own->runs == 0 || result->rows[own->against].runs == 0 || own->ms <= 0)
        return 0;
    return result->rows[own->against].ms / own->ms;
}
