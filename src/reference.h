/* The reference tracer: section by section the algorithm that docs/algorithm.md teaches, scalar, in double.
 * It does no I/O and calls no operating system: what it sees it tells a Recorder. Floor 4. */
#ifndef RECTRAY_REFERENCE_H
#define RECTRAY_REFERENCE_H

#include "geometry.h"
#include "recorder.h"
#include "render.h"
#include "scene.h"

/* The colour of one pixel (RGB, linear, averaged over its samples, not clamped). The recorder may be NULL; counts are
 * added to `report` (not NULL). column in [0, columns), row in [0, rows), row 0 at the top. */
Vec3 reference_pixel(const Scene *scene, int column, int row, RenderReport *report, const Recorder *recorder);

/* The colour of one sample of a pixel: sub-column i and sub-row j of the grid, both in [0, grid). */
Vec3 reference_sample(const Scene *scene, int column, int row, int i, int j, RenderReport *report, const Recorder *recorder);

/* The nearest face hit by a ray in scene coordinates, leaving out the face `skip` (-1: none). */
CastHit reference_nearest(const Scene *scene, Ray ray, int skip, RenderReport *report, const Recorder *recorder);

#endif
