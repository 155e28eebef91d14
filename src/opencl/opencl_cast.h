/* Rays cast at a scene on a device. */
#ifndef RECTRAY_OPENCL_CAST_H
#define RECTRAY_OPENCL_CAST_H

#include "opencl/opencl_session.h"
#include "scene/scene.h"
#include "trace/render.h"

/* The bytes of a number of a ray, and of t, on the device: a double, a float or a pair of floats. */
size_t opencl_cast_bytes(const OpenclSession *session);

/* Turns numbers into the device's, and back. */
void opencl_cast_put(const OpenclSession *session, const double *numbers, size_t count, void *data);
void opencl_cast_get(const OpenclSession *session, const void *data, size_t count, double *numbers);

/* Intersects `count` rays, six doubles each (origin, direction) in scene coordinates, with the scene's faces. */
bool opencl_cast(const Scene *scene, const RenderSettings *settings, const double *rays, long count, CastHit *hits,
                 RenderReport *report, Error *error);

#endif
