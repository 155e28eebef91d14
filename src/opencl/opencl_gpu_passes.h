/* The kernels that render a band on a GPU, one after another, and what they hand on to each other. */
#ifndef RECTRAY_OPENCL_GPU_PASSES_H
#define RECTRAY_OPENCL_GPU_PASSES_H

#include "opencl/opencl_upload.h"

enum { GPU_GROUP_ACROSS = 8, GPU_GROUP_ITEMS = GPU_GROUP_ACROSS * GPU_GROUP_ACROSS }; /* as in kernels/gpu/pixels.cl */

/* A kernel. Its arguments are buffers; then, of the band, the pixels, the number of the first row and the number of
 * rows, as far as it takes them. */
typedef struct GpuPass {
    cl_kernel kernel;
    cl_uint buffers;
    bool takes_picture, takes_rows;
    bool by_pixel;  /* it has a work-item for each pixel of the band; else as many as fill the device */
    bool in_groups; /* its groups are 8 x 8 pixels on any device */
} GpuPass;

/* What the passes count for the host. */
enum { GPU_DOUBTS, GPU_REFINED, GPU_REFINED_DOUBTS, GPU_COUNTS };

enum { GPU_MOST_PASSES = 5 };

typedef struct GpuPasses {
    GpuPass pass[GPU_MOST_PASSES];
    int count;
    cl_mem counts[GPU_COUNTS]; /* of one number each; without adaptive sampling only the first */
    cl_mem doubts;             /* the list of pixels in doubt */
    cl_mem refined, trails;    /* adaptive sampling: the list of pixels to refine; what the centres have met */
    cl_mem refinement;         /* the parameters of refined pixels */
} GpuPasses;

/* How many pixels a band may have, for the lists. */
size_t gpu_passes_most(const OpenclSession *session, const Parameters *parameters);

/* Lists for bands of at most `pixels` pixels, and the kernels. Free them also after a failure. */
bool gpu_passes_make(GpuPasses *passes, OpenclSession *session, const SceneOnDevice *on_device,
                     const Parameters *parameters, size_t pixels, Error *error);
void gpu_passes_free(GpuPasses *passes);

/* Puts the parameters of a picture into the queue. They must stay until it has come to them. */
bool gpu_passes_begin(const GpuPasses *passes, OpenclSession *session, const SceneOnDevice *on_device,
                      const Parameters parameters[2], Error *error);

/* Puts the passes of a band into the queue. Without rows nothing is done but compiling them. The events are those of
 * the first pass and of the last one. */
bool gpu_passes_launch(const GpuPasses *passes, OpenclSession *session, const Parameters *band, cl_mem picture,
                       cl_event events[2], Error *error);

/* How many of the counts there are. */
int gpu_passes_counts(const OpenclSession *session);

#endif
