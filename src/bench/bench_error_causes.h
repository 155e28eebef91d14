/* Which causes the error of the default has. */
#ifndef RECTRAY_BENCH_ERROR_CAUSES_H
#define RECTRAY_BENCH_ERROR_CAUSES_H

#include "bench/bench.h"
#include "bench/bench_ground_truth.h"

/* RMSE of one step of the default's way to a picture, the others as they are: see bench_error_find_causes. */
typedef struct ErrorCauses {
    double arithmetic, sampling, truncation, output, all;
} ErrorCauses;

/* The causes, for the OpenCL backend in float with the scene's sampling and bounces:
 * - arithmetic: float against double on the same rays
 * - sampling: double against the truth
 * - truncation: the scene's bounces against 64
 * - output: linear colours against their bytes
 * - all: the bytes against the truth of 64 bounces. */
bool bench_error_find_causes(ErrorCauses *causes, const Scene *scene, const BenchGroundTruth *truth,
                             const BenchPlan *plan, Error *error);

#endif
