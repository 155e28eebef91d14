/* Time against error: what each choice that the renderer offers costs, and how far its picture is from the truth; and
 * which causes the error of the default has. */
#ifndef RECTRAY_BENCH_ERROR_H
#define RECTRAY_BENCH_ERROR_H

#include "bench/bench.h"
#include "bench/bench_error_causes.h"
#include "bench/bench_picture.h"

enum { ERROR_MAX_CHOICES = 128, ERROR_MAX_SCENES = 16 };

/* Which line of the plot a choice belongs to. */
typedef enum ErrorSeries {
    SERIES_FLOAT,     /* the OpenCL backend in float, grid by grid */
    SERIES_DOUBLE,    /* the same in double */
    SERIES_REFERENCE, /* the reference tracer, grid by grid */
    SERIES_ADAPTIVE,  /* float, adaptive for one N after another */
    SERIES_ADAPTIVE_DOUBLE,
    SERIES_ADAPTIVE_REFERENCE,
    SERIES_BOUNCES, /* float, grid 4, fewer bounces than the scene allows */
    SERIES_ACCEL    /* float, grid 4, other ways of finding faces */
} ErrorSeries;

typedef struct ErrorChoice {
    ErrorSeries series;
    Backend backend;
    Precision precision;
    AccelKind accel;
    int grid;
    bool adaptive; /* more than a ray only where a pixel needs it */
    int bounces;
    char name[48];
    int runs;  /* 0: not measured, it would have taken too long */
    double ms; /* trace time, the median of the runs; where there is none, what was expected */
    BenchDifference error;
    RayCounts rays;
    int better; /* a choice that is faster and, within 1 %, as accurate; -1: none, it is on the Pareto front */
} ErrorChoice;

typedef struct BenchError {
    BenchScene scene;
    int faces, bounces;
    bool adaptive;                   /* so is the default: the scene says so, and no grid was given */
    double truth_error, truth_check; /* see bench_ground_truth.h */
    ErrorChoice choices[ERROR_MAX_CHOICES];
    int choice_count;
    ErrorCauses causes;
} BenchError;

/* Measures every choice for the scene; one that is settled in size and grid, see bench_error_settle. Times are taken in
 * rounds, each choice once a round, so that all see the same load; what takes over a second is run once, what would
 * take over five is left out. */
bool bench_error(BenchError *result, const BenchScene *scene, const BenchPlan *plan, Error *error);

/* Where no size is wanted: the scene's own shape in about 160 x 120 pixels. Where no grid is: the scene's. */
bool bench_error_settle(BenchScene *scene, Error *error);

#endif
