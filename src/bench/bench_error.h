/* Time against error: what each choice that the renderer offers costs, and how far its picture is from the truth;
 * which causes the error of the default has; and what exact arithmetic costs and buys. */
#ifndef RECTRAY_BENCH_ERROR_H
#define RECTRAY_BENCH_ERROR_H

#include "bench/bench.h"
#include "bench/bench_error_arithmetic.h"
#include "bench/bench_error_causes.h"
#include "bench/bench_picture.h"

enum { ERROR_MAX_CHOICES = 128, ERROR_MAX_SCENES = 16 };

/* Which line of the plot a choice belongs to. */
typedef enum ErrorSeries {
    SERIES_FLOAT,     /* the OpenCL backend in float, grid by grid */
    SERIES_DOUBLE,    /* the same in double */
    SERIES_REFERENCE, /* the reference tracer, grid by grid */
    SERIES_TEXTBOOK,  /* the plain kernel, some of the grids: textbook arithmetic in float, ... */
    SERIES_TEXTBOOK_DOUBLE,
    SERIES_PLAIN, /* ... and exact arithmetic */
    SERIES_PLAIN_DOUBLE,
    SERIES_ADAPTIVE, /* float, adaptive for one N after another */
    SERIES_ADAPTIVE_DOUBLE,
    SERIES_ADAPTIVE_REFERENCE,
    SERIES_BOUNCES, /* float, grid 4, fewer bounces than the scene allows */
    SERIES_ACCEL    /* float, grid 4, other ways of finding faces */
} ErrorSeries;

typedef struct ErrorChoice {
    ErrorSeries series;
    Backend backend;
    Precision precision;
    KernelKind kernel;
    Arithmetic arithmetic;
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
    bool adaptive;        /* so is the default: the scene says so, and no grid was given */
    bool arithmetic_only; /* of all this, `arithmetic` alone was measured */
    ErrorArithmetic arithmetic;
    double truth_error, truth_check; /* see bench_ground_truth.h */
    ErrorChoice choices[ERROR_MAX_CHOICES];
    int choice_count;
    ErrorCauses causes;
} BenchError;

typedef struct BenchErrors {
    BenchError scenes[ERROR_MAX_SCENES];
    int count;
    BenchPlan plan;
    double load; /* see bench_machine.h */
} BenchErrors;

/* Measures every choice for the scene. Where no size is wanted: its own shape in about 160 x 120 pixels. Where no grid
 * is: its own. Times are taken in rounds, each choice once a round, so that all see the same load; what takes over a
 * second is run once, what would take over five is left out. */
bool bench_error(BenchError *result, const BenchScene *scene, const BenchPlan *plan, Error *error);

/* Measures for the scene what exact arithmetic costs and buys, and nothing else. */
bool bench_error_arithmetic_only(BenchError *result, const BenchScene *scene, const BenchPlan *plan, Error *error);

#endif
