/* Comma-separated values, as RFC 4180 has them. */
#ifndef RECTRAY_BENCH_CSV_H
#define RECTRAY_BENCH_CSV_H

#include <stdio.h>

/* In quotes, a quote doubled. */
void bench_csv_text(FILE *out, const char *text);

#endif
