/* The OpenCL backend: finds a device, builds the kernels, uploads a scene, renders it or casts rays at it. */
#ifndef RECTRAY_OPENCL_H
#define RECTRAY_OPENCL_H

#include "trace/render.h"
#include "scene/scene.h"

typedef struct DeviceInfo {
    int number; /* for --device */
    char platform[128], name[128], version[128], driver[128];
    char type[16]; /* "CPU", "GPU", "accelerator" */
    int compute_units;
    int has_double;
    int lanes_float, lanes_double; /* what the backend would use */
    long long memory_bytes;
} DeviceInfo;

/* Lists the devices of all platforms, in the loader's order. *count is their number; the caller frees *devices.
 * No platform or no device is an ERROR_SYSTEM that says what to install. */
bool opencl_devices(DeviceInfo **devices, int *count, Error *error);

/* A scene on the device that the settings name, with its tree and its kernel, for one picture after another. */
typedef struct OpenclScene OpenclScene;

/* Puts it there; the scene, and what settings->linear points to, must outlive it. NULL, with the error filled: no such device,
 * no double on it, a kernel that does not compile (with the compiler's log), memory, any failing call by name. */
OpenclScene *opencl_hold(const Scene *scene, const RenderSettings *settings, Error *error);

/* Renders it. The report tells, besides this picture, what was done once for all. Errors: memory, any failing call by name,
 * those of the sink. */
bool opencl_picture(OpenclScene *held, BandSink sink, RenderReport *report, Error *error);

/* What was done once for all. */
const RenderReport *opencl_held_report(const OpenclScene *held);

/* NULL is allowed. */
void opencl_release(OpenclScene *held);

/* All three for a single picture. */
bool opencl_render(const Scene *scene, const RenderSettings *settings, BandSink sink, RenderReport *report, Error *error);

/* Intersects `count` rays, six doubles each (origin, direction) in scene coordinates, with the scene's faces. */
bool opencl_cast(const Scene *scene, const RenderSettings *settings, const double *rays, long count, CastHit *hits,
                 RenderReport *report, Error *error);

#endif
