/* The ladder of kernels as tables, and as columns for gnuplot. */
#ifndef RECTRAY_BENCH_KERNELS_REPORT_H
#define RECTRAY_BENCH_KERNELS_REPORT_H

#include "bench/bench_kernels.h"

#include <stdio.h>

typedef struct BenchKernelScenes {
    BenchKernels scenes[KERNELS_MAX_SCENES];
    int count;
    BenchPlan plan;
    double load; /* see bench_machine.h */
} BenchKernelScenes;

/* `data` is a BenchKernelScenes, so that bench_document.h may call this. Writing errors stay in `out`. */
void bench_kernels_print_markdown(FILE *out, const void *data);

/* One scene's rows, a line each after a header, into kernels-NAME.tsv in the folder. */
bool bench_kernels_write_tsv(const BenchKernels *result, const BenchFolder *folder, Error *error);

#endif
