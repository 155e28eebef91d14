/* What leaving work out buys: pictures traced with it left out, and with it done. */
#ifndef RECTRAY_BENCH_SKIP_H
#define RECTRAY_BENCH_SKIP_H

#include "bench/bench.h"
#include "scene/scene.h"

/* A kind of work left out of a scene, and what tracing takes with it left out and with it done. */
typedef struct BenchSkip {
    uint64_t count; /* 0: the scene lets none of it be left out, and nothing was measured */
    double left_ms, done_ms;
    bool same; /* the two pictures */
} BenchSkip;

/* Measures, turn by turn, each kind of work that was left out of the scene when the report was made. */
bool bench_skips(BenchSkip skips[SKIP_KINDS], const RenderReport *report, const Scene *scene, const BenchPlan *plan,
                 Error *error);

#endif
