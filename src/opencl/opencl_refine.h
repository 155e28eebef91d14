/* Adaptive sampling on a device: of a band whose centres are rendered, the pixels that need more get their samples. */
#ifndef RECTRAY_OPENCL_REFINE_H
#define RECTRAY_OPENCL_REFINE_H

#include "opencl/opencl_upload.h"

/* What a pixel of a band takes on the device, and as much on the host: its flag, and its place in the list. */
enum { REFINEMENT_BYTES = 1 + sizeof(cl_int) };

typedef struct Refinement {
    cl_mem flags, list; /* buffers of the kernel `render_adaptive` */
    unsigned char *read_flags;
    cl_int *pixels;
} Refinement;

/* For bands of at most `most` pixels. Free it also after a failure. */
bool opencl_refinement(Refinement *refinement, OpenclSession *session, size_t most, Error *error);
void opencl_refinement_free(Refinement *refinement);

/* Refines the band of the parameters; adds times and counts to the report. */
bool opencl_refine(OpenclSession *session, const SceneOnDevice *on_device, cl_kernel kernel,
                   const Refinement *refinement, Parameters band, RenderReport *report, Error *error);

#endif
