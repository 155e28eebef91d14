/* The measurements of whole processes as tables, and as columns for gnuplot. */
#ifndef RECTRAY_BENCH_PROCESS_REPORT_H
#define RECTRAY_BENCH_PROCESS_REPORT_H

#include "bench/bench_process.h"

#include <stdio.h>

/* Whole processes: of one scene each, and of scenes with ever more faces. */
typedef struct BenchProcesses {
    const BenchProcess *list, *curve;
    int count, curve_count;
} BenchProcesses;

/* A number in a cell, with three figures or so; a dash for what is not there. */
void bench_cell(FILE *out, double value);

/* Nothing where no process was measured. Writing errors stay in `out`. */
void bench_print_processes(FILE *out, const BenchProcesses *measured);

/* process.dat in the folder, for docs/plots. */
bool bench_write_process_data(const BenchProcesses *measured, const BenchFolder *folder, Error *error);

#endif
