/* Rays cast at a scene with the reference tracer. */
#ifndef RECTRAY_REFERENCE_CAST_H
#define RECTRAY_REFERENCE_CAST_H

#include "trace/accel.h"
#include "trace/render.h"

/* Intersects `count` rays, six doubles each (origin, direction) in scene coordinates, with the scene's faces. */
void reference_cast(const Scene *scene, const Accel *accel, const double *rays, long count, CastHit *hits,
                    RenderReport *report);

#endif
