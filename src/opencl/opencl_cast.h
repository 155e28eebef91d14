/* Rays cast at a scene on a device. */
#ifndef RECTRAY_OPENCL_CAST_H
#define RECTRAY_OPENCL_CAST_H

#include "scene/scene.h"
#include "trace/render.h"

/* Intersects `count` rays, six doubles each (origin, direction) in scene coordinates, with the scene's faces. */
bool opencl_cast(const Scene *scene, const RenderSettings *settings, const double *rays, long count, CastHit *hits,
                 RenderReport *report, Error *error);

#endif
