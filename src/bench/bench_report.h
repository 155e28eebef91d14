/* The measurements as tables for docs/performance.md, and as columns for gnuplot. */
#ifndef RECTRAY_BENCH_REPORT_H
#define RECTRAY_BENCH_REPORT_H

#include "bench/bench_process.h"
#include "bench/bench_trace.h"

#include <stdio.h>

enum { BENCH_MAX_SCENES = 16 };

typedef struct Bench {
    BenchTrace traces[BENCH_MAX_SCENES], scaling[BENCH_MAX_SCENES];
    BenchProcess processes[BENCH_MAX_SCENES];
    BenchProcess curve[BENCH_MAX_SCENES]; /* from few faces to many */
    int trace_count, scaling_count, process_count, curve_count;
    BenchPlan plan;
    double load; /* see bench_machine.h */
} Bench;

/* `data` is a Bench, so that bench_document.h may call this. Writing errors stay in `out`. */
void bench_print_markdown(FILE *out, const void *data);

/* ladder.dat, scaling.dat and process.dat in the folder, for docs/plots. */
bool bench_write_plot_data(const Bench *bench, Error *error);

#endif
