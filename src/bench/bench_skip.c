/* What leaving work out buys. For each kind of work that the scene does not need, two pictures are traced alternately:
 * one leaves it out, the other does it. */
#include "bench/bench_skip.h"

#include "bench/bench_measure.h"

#include <stdlib.h>
#include <string.h>

enum { MOST_REPEATS = 5 };

static bool same_picture(const Image *a, const Image *b)
{
    return memcmp(a->rgb, b->rgb, (size_t)a->columns * (size_t)a->rows * 3) == 0;
}

/* The two sides: the scene held with all left out, and a picture for each. */
typedef struct Sides {
    OpenclScene *held;
    Image left, done;
} Sides;

/* One kind of work. */
static bool measure_skip(BenchSkip *result, int skip, const Scene *scene, Sides *sides, const BenchPlan *plan,
                         Error *error)
{
    double times[2][MOST_REPEATS];
    int repeats = plan->repeats < MOST_REPEATS ? plan->repeats : MOST_REPEATS;
    RenderSettings with = plan->settings;
    with.no_skip |= 1u << skip;
    OpenclScene *held[2] = {sides->held, opencl_hold(scene, &with, error)};
    bool ok = held[1] != NULL;
    for (int i = -1; i < repeats && ok; i++) /* -1: to warm up */
        for (int side = 0; side < 2 && ok; side++) {
            RenderReport report;
            ok = bench_trace_once(held[side], side == 0 ? &sides->left : &sides->done, &report, error);
            times[side][i < 0 ? 0 : i] = report.trace_ms;
        }
    opencl_release(held[1]);
    if (!ok)
        return false;
    result->left_ms = bench_median(times[0], repeats);
    result->done_ms = bench_median(times[1], repeats);
    result->same = same_picture(&sides->left, &sides->done);
    return true;
}

bool bench_skips(BenchSkip skips[SKIP_KINDS], const RenderReport *report, const Scene *scene, const BenchPlan *plan,
                 Error *error)
{
    size_t bytes = (size_t)scene->screen.columns * (size_t)scene->screen.rows * 3;
    Sides sides = {.left = {scene->screen.columns, scene->screen.rows, malloc(bytes)}};
    sides.done = (Image){scene->screen.columns, scene->screen.rows, malloc(bytes)};
    bool ok = (sides.left.rgb && sides.done.rgb) || error_memory(error, "two pictures");
    sides.held = ok ? opencl_hold(scene, &plan->settings, error) : NULL;
    ok = sides.held != NULL;
    for (int skip = 0; ok && skip < SKIP_KINDS; skip++) {
        skips[skip].count = report->skipped[skip];
        if (skips[skip].count > 0)
            ok = measure_skip(&skips[skip], skip, scene, &sides, plan, error);
    }
    opencl_release(sides.held);
    image_free(&sides.left);
    image_free(&sides.done);
    return ok;
}
