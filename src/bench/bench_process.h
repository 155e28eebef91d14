/* What a user waits for: a whole `render` process, and one of POV-Ray. */
#ifndef RECTRAY_BENCH_PROCESS_H
#define RECTRAY_BENCH_PROCESS_H

#include "bench/bench.h"

#define BENCH_EXPORT "build/peers/povray_export"

typedef struct BenchPhases {
    double parse, build, device, compile, upload, trace, readback, encode, total;
} BenchPhases;

/* A whole `render` process; wall_ms is measured from outside. */
typedef struct BenchProcess {
    BenchScene scene;
    BenchPhases cold, warm;                            /* cold: with an empty kernel cache */
    double cold_wall_ms, warm_wall_ms, povray_wall_ms; /* povray: 0 where it is not there */
    double peak_bytes;
    int faces;
} BenchProcess;

/* Renders the scene, which must be settled, by starting this program again and again. To be called before bench_trace:
 * on Linux a process begins with the peak memory of the one that started it. */
bool bench_process(BenchProcess *result, const BenchScene *scene, const BenchPlan *plan, Error *error);

/* The same without cold runs. */
bool bench_process_warm(BenchProcess *result, const BenchScene *scene, const BenchPlan *plan, Error *error);

/* The same for POV-Ray and the exported scene; leaves 0 where either program is missing. */
bool bench_povray(BenchProcess *result, const BenchPlan *plan, Error *error);

#endif
