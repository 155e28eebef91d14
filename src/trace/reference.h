/* The reference tracer: section by section the algorithm that docs/algorithm.md teaches, scalar, in double.
 * It does no I/O and calls no operating system: what it sees it tells a Recorder. */
#ifndef RECTRAY_REFERENCE_H
#define RECTRAY_REFERENCE_H

#include "scene/geometry.h"
#include "scene/scene.h"
#include "trace/accel.h"
#include "trace/adaptive.h"
#include "trace/recorder.h"
#include "trace/render.h"

/* What the tracer works with. */
typedef struct Tracer {
    const Scene *scene;
    const Accel *accel;       /* NULL: every face is tested, in file order */
    RenderReport *report;     /* counts are added to it */
    const Recorder *recorder; /* NULL: silent */
    Path *path;               /* gets the faces of each sample's path; NULL: not wanted */
} Tracer;

/* The colour of one pixel (RGB, linear, averaged over the samples that it gets, not clamped). column in [0, columns),
 * row in [0, rows), row 0 at the top. */
Vec3 reference_pixel(const Tracer *tracer, int column, int row);

/* The colour of one sample of a pixel: sub-column i and sub-row j of the grid, both in [0, grid). */
Vec3 reference_sample(const Tracer *tracer, int column, int row, int i, int j);

/* The nearest face hit by a ray in scene coordinates, leaving out the face `from`, which it leaves (-1: none). */
CastHit reference_nearest(const Tracer *tracer, Ray ray, int from);

#endif
