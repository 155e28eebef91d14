/* What exact arithmetic costs and buys, as tables and as CSV for a plot. */
#ifndef RECTRAY_BENCH_ARITHMETIC_REPORT_H
#define RECTRAY_BENCH_ARITHMETIC_REPORT_H

#include "bench/bench_error.h"

#include <stdio.h>

/* A line for each scene: times, then errors. */
void bench_arithmetic_print_markdown(FILE *out, const BenchErrors *errors);

/* A line for each row of each scene, after a header, into arithmetic.csv in the folder. */
bool bench_arithmetic_write_csv(const BenchErrors *errors, const BenchFolder *folder, Error *error);

#endif
