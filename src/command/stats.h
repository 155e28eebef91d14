/* What was done and how long it took: --stats, as a table or as JSON. */
#ifndef RECTRAY_STATS_H
#define RECTRAY_STATS_H

#include "base/error.h"
#include "scene/scene.h"
#include "trace/render.h"

#include <stdbool.h>
#include <stdio.h>

typedef enum StatsFormat { STATS_NONE, STATS_TEXT, STATS_JSON } StatsFormat;

typedef struct Stats {
    RenderReport report; /* what the backend measured */
    double parse_ms, encode_ms, total_ms;
    int faces, lights;
    Backend backend;
    Precision precision;
    Arithmetic arithmetic;
} Stats;

/* What is known before anything is traced. The reference computes in double whatever the precision. */
Stats stats_begin(const Scene *scene, Backend backend, Precision precision);

/* Adds the times and counts of another picture; what is no sum is the other's. */
void stats_add(Stats *sum, const Stats *other);

/* STATS_TEXT: a table for people. STATS_JSON: one object on one line; every number keeps all its digits.
 * Fails only for want of memory; writing errors stay in `out`. */
bool stats_print(FILE *out, StatsFormat format, const Stats *stats, Error *error);

#endif
