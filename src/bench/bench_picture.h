/* Pictures in linear colours, and how far two of them are apart. */
#ifndef RECTRAY_BENCH_PICTURE_H
#define RECTRAY_BENCH_PICTURE_H

#include "scene/scene.h"
#include "trace/render.h"

typedef struct BenchPicture {
    int columns, rows;
    double *rgb; /* rows * columns * 3, from the top, not clamped */
    RenderReport report;
} BenchPicture;

/* Traces the scene with a backend; the picture is to be freed also after a failure. */
bool bench_picture(BenchPicture *picture, const Scene *scene, Backend backend, const RenderSettings *settings,
                   Error *error);

/* A black picture of that size. */
bool bench_picture_blank(BenchPicture *picture, int columns, int rows, Error *error);
void bench_picture_free(BenchPicture *picture);

/* Replaces each colour by the one that its byte stands for. */
void bench_picture_quantise(BenchPicture *picture);

/* Colours are clamped to [0, 1] before they are compared. */
typedef struct BenchDifference {
    double rmse; /* over all pixels and channels */
    double most; /* of a channel */
    double off;  /* the share of pixels of which a channel is off by more than 1/255 */
} BenchDifference;

/* The pictures must have one size. */
BenchDifference bench_difference(const BenchPicture *a, const BenchPicture *b);

#endif
