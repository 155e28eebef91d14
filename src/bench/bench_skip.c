/* What leaving work out buys: the scene traced with each kind of work left out that it lets be left out, and with that
 * work done, turn by turn. */
#include "bench/bench.h"

#include "trace/skip.h"

#include <stdlib.h>
#include <string.h>

enum { MOST_REPEATS = 5 };

static bool same_picture(const Image *a, const Image *b)
{
    return memcmp(a->rgb, b->rgb, (size_t)a->columns * (size_t)a->rows * 3) == 0;
}

/* One kind; `held` is the scene with all left out, `done` and `left` are pictures for the two sides. */
static bool measure_skip(BenchSkip *result, int skip, const Scene *scene, OpenclScene *held, const BenchPlan *plan, Image *left,
                         Image *done, Error *error)
{
    double times[2][MOST_REPEATS];
    int repeats = plan->repeats < MOST_REPEATS ? plan->repeats : MOST_REPEATS;
    RenderSettings with = plan->settings;
    with.no_skip |= 1u << skip;
    OpenclScene *sides[2] = {held, opencl_hold(scene, &with, error)};
    bool ok = sides[1] != NULL;
    for (int i = -1; i < repeats && ok; i++) /* -1: to warm up */
        for (int side = 0; side < 2 && ok; side++) {
            RenderReport report;
            ok = bench_trace_once(sides[side], side == 0 ? left : done, &report, error);
            times[side][i < 0 ? 0 : i] = report.trace_ms;
        }
    opencl_release(sides[1]);
    if (!ok)
        return false;
    result->left_ms = bench_median(times[0], repeats);
    result->done_ms = bench_median(times[1], repeats);
    result->same = same_picture(left, done);
    return true;
}

bool bench_skips(BenchTrace *result, const Scene *scene, const BenchPlan *plan, Error *error)
{
    size_t bytes = (size_t)scene->screen.columns * (size_t)scene->screen.rows * 3;
    Image left = {scene->screen.columns, scene->screen.rows, malloc(bytes)}, done = left;
    done.rgb = malloc(bytes);
    bool ok = (left.rgb && done.rgb) || error_memory(error, "two pictures");
    OpenclScene *held = ok ? opencl_hold(scene, &plan->settings, error) : NULL;
    ok = held != NULL;
    for (int skip = 0; ok && skip < SKIPS; skip++) {
        result->skips[skip].count = result->report.skipped[skip];
        if (result->skips[skip].count > 0)
            ok = measure_skip(&result->skips[skip], skip, scene, held, plan, &left, &done, error);
    }
    opencl_release(held);
    image_free(&left);
    image_free(&done);
    return ok;
}
