/* What leaving work out buys: the scene traced with each kind of work left out that it lets be left out, and with that
 * work done, turn by turn. */
#include "bench.h"

#include "skip.h"

#include <stdlib.h>
#include <string.h>

enum { MOST_REPEATS = 5 };

static bool same_picture(const Image *a, const Image *b)
{
    return memcmp(a->rgb, b->rgb, (size_t)a->columns * (size_t)a->rows * 3) == 0;
}

/* One kind; `done` and `left` are pictures for the two sides. */
static bool measure_skip(BenchSkip *result, int skip, const Scene *scene, const BenchPlan *plan, Image *left, Image *done,
                         Error *error)
{
    double times[2][MOST_REPEATS];
    int repeats = plan->repeats < MOST_REPEATS ? plan->repeats : MOST_REPEATS;
    RenderSettings settings[2] = {plan->settings, plan->settings};
    settings[1].no_skip |= 1u << skip;
    for (int i = -1; i < repeats; i++) /* -1: to warm up */
        for (int side = 0; side < 2; side++) {
            RenderReport report;
            if (!bench_trace_once(scene, &settings[side], side == 0 ? left : done, &report, error))
                return false;
            times[side][i < 0 ? 0 : i] = report.trace_ms;
        }
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
    for (int skip = 0; ok && skip < SKIPS; skip++) {
        result->skips[skip].count = result->report.skipped[skip];
        if (result->skips[skip].count > 0)
            ok = measure_skip(&result->skips[skip], skip, scene, plan, &left, &done, error);
    }
    image_free(&left);
    image_free(&done);
    return ok;
}
