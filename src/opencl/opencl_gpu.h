/* Rendering by kernels/gpu.cl: a band's pixels in float, then those in doubt exactly. With adaptive sampling these are
 * the centres; then the pixels are judged, and some get their samples (kernels/gpu_adaptive.cl). While a band is
 * traced, the one before it is encoded: nothing waits but for pixels. */
#ifndef RECTRAY_OPENCL_GPU_H
#define RECTRAY_OPENCL_GPU_H

#include "opencl/opencl_gpu_passes.h"
#include "opencl/opencl_pixels.h"
#include "opencl/opencl_upload.h"

enum { GPU_COUNTERS = COUNTER_STRIPES * COUNTER_STRIDE };

/* A band on its way. */
typedef struct GpuBand {
    Pixels pixels;
    Parameters of; /* its rows */
    cl_uint counters[GPU_COUNTERS];
    cl_uint counts[GPU_COUNTS];
    cl_event traced[2], read; /* its first and last kernel, and the last read; NULL: none is on its way */
} GpuBand;

enum { GPU_BANDS = 2 };

typedef struct GpuPath {
    OpenclSession *session;
    const SceneOnDevice *on_device;
    Parameters parameters[2]; /* of the region, without rows; adaptive: of the centres, and of refined pixels */
    Region region;            /* what is rendered */
    GpuPasses passes;
    int most_rows; /* of a band */
    GpuBand bands[GPU_BANDS];
} GpuPath;

/* Kernels and buffers for pictures of a region, of a scene on a device; linear: as in RenderSettings. Runs each kernel
 * once without work, so that it is compiled, and keeps the programs; that time goes to the report. Free it also after a
 * failure. */
bool gpu_path_make(GpuPath *path, OpenclSession *session, const SceneOnDevice *on_device, Parameters parameters,
                   double *linear, const Region *region, RenderReport *report, Error *error);
void gpu_path_free(GpuPath *path);

/* From now on linear colours go there. */
void gpu_path_fill(GpuPath *path, double *linear);

/* Renders a picture of what is on the device now, with these parameters but for the band; adds times and counts to the
 * report. */
bool gpu_path_picture(GpuPath *path, Parameters parameters, BandSink sink, RenderReport *report, Error *error);

#endif
