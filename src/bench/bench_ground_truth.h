/* The truth that bench error measures against: the box-filtered
 * colours of a scene's pixels, from some 8000 rays each. */
#ifndef RECTRAY_BENCH_GROUND_TRUTH_H
#define RECTRAY_BENCH_GROUND_TRUTH_H

#include "bench/bench_picture.h"

enum { TRUTH_GRID = 64, TRUTH_CHECKS = 16 };

typedef struct BenchGroundTruth {
    BenchPicture picture;
    double own_error; /* RMSE, as estimated: see bench_ground_truth */
    double check;     /* the largest difference of a channel from the reference tracer, of TRUTH_CHECKS pixels */
} BenchGroundTruth;

/* Traces the scene by the double kernel with grids of 64 and of 63, which share no ray,
 * and takes their mean. Half their difference is an estimate of its error: were the errors
 * of the two independent, the mean's would be as large. The reference tracer then traces
 * some pixels with the grid of 64, too. The truth is to be freed also after a failure. */
bool bench_ground_truth(BenchGroundTruth *truth, const Scene *scene, const RenderSettings *settings, Error *error);
void bench_ground_truth_free(BenchGroundTruth *truth);

/* The scene's picture by the double kernel with any grid. It is traced in a larger size and averaged over blocks of
 * pixels: the same rays, which the kernel traces faster side by side. */
bool bench_picture_fine(BenchPicture *picture, const Scene *scene, int grid, const RenderSettings *settings,
                        Error *error);

#endif
