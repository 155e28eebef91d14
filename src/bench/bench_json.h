/* The measurements as JSON. */
#ifndef RECTRAY_BENCH_JSON_H
#define RECTRAY_BENCH_JSON_H

#include "bench/bench_report.h"

/* One object on one line. Fails only for want of memory. */
bool bench_print_json(FILE *out, const Bench *bench, Error *error);

#endif
