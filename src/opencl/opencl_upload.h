/* A scene on a device, ready to be traced: buffers, kernels for its tree, launches and what they counted. */
#ifndef RECTRAY_OPENCL_UPLOAD_H
#define RECTRAY_OPENCL_UPLOAD_H

#include "opencl/opencl_session.h"
#include "scene/scene.h"

#include "kernels/shared/layout.h"

typedef struct SceneOnDevice {
    cl_mem parameters, faces, face_rows, planes, materials, lights, view, counters, tree_floats, tree_ints;
    const unsigned char *closed; /* the session's: the faces of closed boxes, as they were packed */
} SceneOnDevice;

/* From settings and a scene to a session with buffers and a program for its kernel; the session is to be closed also
 * after a failure. One whose buffers were dropped may be given again: its device stays, and its program if it fits.
 * Times, and a tree that was left out, go to the report. */
bool opencl_prepare(OpenclSession *session, const Scene *scene, const RenderSettings *settings,
                    SceneOnDevice *on_device, RenderReport *report, Error *error);

/* skip_closed_boxes, where the settings want it; the caller frees it. NULL without memory. */
unsigned char *opencl_closed_boxes(const Scene *scene, const RenderSettings *settings, Error *error);

/* What the kernels are told of the scene; the caller adds the rows of the band or the number of rays. */
Parameters opencl_parameters(const Scene *scene);

/* A launch without work: some devices compile a kernel when it first runs, and that is no part of tracing. Then the
 * program is kept for later runs. */
bool opencl_warm_up(OpenclSession *session, const SceneOnDevice *on_device, cl_kernel kernel, Parameters parameters,
                    RenderReport *report, Error *error);

/* Runs the kernel on at least `items` work-items; adds time and counters to the report. */
bool opencl_launch(OpenclSession *session, const SceneOnDevice *on_device, cl_kernel kernel,
                   const Parameters *parameters, size_t items, RenderReport *report, Error *error);

/* Adds counters that were read from the device, COUNTER_STRIPES rows of COUNTER_STRIDE, to the report. */
void opencl_add_counters(const unsigned *counters, RenderReport *report);

/* Copies a buffer to the host; adds the time to the report. */
bool opencl_read(OpenclSession *session, cl_mem buffer, size_t bytes, void *data, RenderReport *report, Error *error);

/* A part of each of some rows of a buffer, in bytes. */
typedef struct Rectangle {
    size_t row_bytes;   /* of a whole row */
    size_t left, bytes; /* where the part begins in its row, and how much it is */
    size_t top, rows;
} Rectangle;

/* The same for a rectangle of it, whose parts then stand one after the other. */
bool opencl_read_rectangle(OpenclSession *session, cl_mem buffer, Rectangle r, void *data, RenderReport *report,
                           Error *error);

#endif
