/* The ladder of kernels: one scene, traced by the reference, by the plain kernel and by packets, one idea after
 * another. Each row has its time, what it tested, and whether its picture is that of the reference. */
#ifndef RECTRAY_BENCH_KERNELS_H
#define RECTRAY_BENCH_KERNELS_H

#include "bench/bench.h"

#include <stddef.h>

enum { KERNELS_MAX_ROWS = 16, KERNELS_MAX_SCENES = 16 };

typedef struct KernelRow {
    char name[64];
    int against; /* the row that its time is compared with; -1: none */
    Backend backend;
    KernelKind kernel;
    AccelKind accel;
    int lanes;
    bool tiles;      /* tiles are classified */
    bool one_thread; /* not as many as the plan says */
    int runs;        /* 0: left out, it would take minutes */
    double ms;       /* trace time, the median of the runs */
    uint64_t box_tests, face_tests;
    size_t differing; /* pixels that are not those of the reference */
    size_t off;       /* of them, those with a channel off by more than 1 of 255 */
} KernelRow;

typedef struct BenchKernels {
    BenchScene scene;
    int faces;
    KernelRow rows[KERNELS_MAX_ROWS];
    int row_count;
} BenchKernels;

/* Measures every row for the scene. Where no size is wanted: the scene's own shape in about 320 x 240 pixels; where no
 * grid is: one ray per pixel. Times are taken in rounds, each row once a round, so that all see the same load. What
 * takes over a second is run once. */
bool bench_kernels(BenchKernels *result, const BenchScene *scene, const BenchPlan *plan, Error *error);

/* How often the row is as fast as the one that it is compared with; 0 where one of them was left out. */
double bench_kernels_ratio(const BenchKernels *result, int row);

#endif
