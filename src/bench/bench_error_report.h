/* Time against error as tables, as CSV for plots. */
#ifndef RECTRAY_BENCH_ERROR_REPORT_H
#define RECTRAY_BENCH_ERROR_REPORT_H

#include "bench/bench_error.h"

#include <stdio.h>

/* `data` is a BenchErrors, so that bench_document.h may call this. Writing errors stay in `out`. */
void bench_error_print_markdown(FILE *out, const void *data);

/* One scene's choices, a line each after a header, into error-NAME.csv in the folder. */
bool bench_error_write_csv(const BenchError *result, const BenchFolder *folder, Error *error);

#endif
