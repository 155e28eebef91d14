/* What all measurements are made of: pictures that are timed, and the median of the times. */
#ifndef RECTRAY_BENCH_MEASURE_H
#define RECTRAY_BENCH_MEASURE_H

#include "base/error.h"
#include "opencl/opencl.h"
#include "picture/image.h"

/* Where the bands of a picture go: into `picture`, of the scene's size, or nowhere where it is NULL. */
BandSink bench_sink(Image *picture);

/* One picture of ours; `picture`, of the scene's size, is filled where it is not NULL. */
bool bench_trace_once(OpenclScene *held, Image *picture, RenderReport *report, Error *error);

/* Sorts the times and returns the middle one, the mean of the middle two where their number is even. */
double bench_median(double *times, int count);

#endif
