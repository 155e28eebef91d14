/* The measurements as tables for docs/performance.md, as JSON, and as columns for gnuplot. */
#ifndef RECTRAY_BENCH_REPORT_H
#define RECTRAY_BENCH_REPORT_H

#include "bench/bench.h"

#include <stdio.h>

enum { BENCH_MAX_SCENES = 16 };

typedef struct Bench {
    BenchTrace traces[BENCH_MAX_SCENES], scaling[BENCH_MAX_SCENES];
    BenchProcess processes[BENCH_MAX_SCENES];
    int trace_count, scaling_count, process_count;
    BenchPlan plan;
    double load; /* see bench_load */
} Bench;

/* `data` is a Bench, so that bench_document.h may call this. Writing errors stay in `out`. */
void bench_print_markdown(FILE *out, const void *data);

/* One object on one line. Fails only for want of memory. */
bool bench_print_json(FILE *out, const Bench *bench, Error *error);

/* ladder.dat and scaling.dat in the folder, for docs/plots. */
bool bench_write_plot_data(const Bench *bench, Error *error);

/* The processor's name as the system tells it; "unknown processor" where it does not. */
const char *bench_processor(char *name, size_t size);

/* How many programs wanted a core in the last minute, on average; 0 where the system does not tell. */
double bench_load(void);

#endif
