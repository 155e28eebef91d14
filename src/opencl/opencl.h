/* The OpenCL backend: uploads a scene to a device, renders it, or casts rays at it. */
#ifndef RECTRAY_OPENCL_H
#define RECTRAY_OPENCL_H

#include "scene/scene.h"
#include "trace/render.h"

/* A scene on the device that the settings name, with its tree and its kernel, for one picture after another. */
typedef struct OpenclScene OpenclScene;

/* Puts a scene on the device, to render the region of the settings; the scene, and what settings->linear points to,
 * must outlive it. NULL, with the error filled: no such device, no double on it, settings that the kernel cannot meet
 * (with the way out), a kernel that does not compile (with the compiler's log), memory, any failing call by name. */
OpenclScene *opencl_hold(const Scene *scene, const RenderSettings *settings, Error *error);

/* Renders it. The report tells, besides this picture, what was done once for all. Errors: memory, any failing call by
 * name, those of the sink. */
bool opencl_picture(OpenclScene *held, BandSink sink, RenderReport *report, Error *error);

/* Puts another scene in the place of the held one, with the settings of opencl_hold, a picture of the same size and the
 * same sampling. Device and kernel stay; with `same_faces`, where nothing but camera and lights may differ, so do the
 * faces and their tree. After that the report tells what was done for this scene. After a failure release it. */
bool opencl_exchange(OpenclScene *held, const Scene *scene, bool same_faces, const RenderSettings *settings,
                     Error *error);

/* What was done once for all. */
const RenderReport *opencl_held_report(const OpenclScene *held);

/* NULL is allowed. */
void opencl_release(OpenclScene *held);

/* Holds, renders and releases a scene for a single picture. */
bool opencl_render(const Scene *scene, const RenderSettings *settings, BandSink sink, RenderReport *report,
                   Error *error);

#endif
