/* What is to be measured, and how. What comes of it: bench_trace.h (scenes traced in this process, beside a peer),
 * bench_process.h (whole processes), bench_error.h, bench_kernels.h; bench_report.h makes tables of the first two. */
#ifndef RECTRAY_BENCH_H
#define RECTRAY_BENCH_H

#include "bench/bench_folder.h"
#include "trace/render.h"

enum { BENCH_MAX_REPEATS = 99, BENCH_NAME = 64 };

/* A scene to measure; size 0x0 and grid 0 mean: as the scene says. */
typedef struct BenchScene {
    char name[BENCH_NAME], path[512];
    int columns, rows, grid;
} BenchScene;

/* How to measure. */
typedef struct BenchPlan {
    RenderSettings settings;
    int repeats;        /* pictures to take the median of */
    bool skips;         /* measure, too, what is left out */
    bool tells;         /* the notes on scenes that a user names */
    BenchFolder folder; /* for generated scenes, pictures, caches and the data of plots */
} BenchPlan;

#endif
