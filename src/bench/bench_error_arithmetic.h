/* What exact arithmetic costs and what it buys: the textbook's beside it, kernel by kernel, all with the same rays. */
#ifndef RECTRAY_BENCH_ERROR_ARITHMETIC_H
#define RECTRAY_BENCH_ERROR_ARITHMETIC_H

#include "bench/bench.h"
#include "bench/bench_picture.h"

typedef struct ArithmeticRow {
    KernelKind kernel;
    Arithmetic arithmetic;
    Precision precision;
    int runs;
    double ms;             /* trace time, the median of the runs */
    BenchDifference error; /* from the reference's exact picture of the same rays */
} ArithmeticRow;

/* Packets are exact only, and come last. */
enum {
    ROW_TEXTBOOK_FLOAT,
    ROW_EXACT_FLOAT,
    ROW_TEXTBOOK_DOUBLE,
    ROW_EXACT_DOUBLE,
    ROW_PACKET_FLOAT,
    ROW_PACKET_DOUBLE,
    ARITHMETIC_ROWS
};

typedef struct ErrorArithmetic {
    int columns, rows; /* the scene's own, or its shape in 76 800 pixels where it has more; those asked for */
    ArithmeticRow row[ARITHMETIC_ROWS];
} ErrorArithmetic;

/* "plain/textbook/float". */
typedef struct ArithmeticName {
    char text[48];
} ArithmeticName;

ArithmeticName bench_arithmetic_name(const ArithmeticRow *row);

/* Measures the rows with one ray per pixel, in turns. `wanted` has a size, or 0x0. */
bool bench_error_arithmetic(ErrorArithmetic *result, const Scene *scene, const BenchScene *wanted,
                            const BenchPlan *plan, Error *error);

#endif
