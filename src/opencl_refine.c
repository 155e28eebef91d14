/* Adaptive sampling on a device. The list of pixels is made here, in their order, so that a picture is the same each time. */
#include "opencl_refine.h"

#include "clock.h"

#include <stdlib.h>

bool opencl_refinement(Refinement *refinement, OpenclSession *session, size_t most, Error *error)
{
    *refinement = (Refinement){.read_flags = malloc(most), .pixels = malloc(most * sizeof(cl_int))};
    if (!refinement->read_flags || !refinement->pixels)
        return error_memory(error, "the pixels to refine");
    return (refinement->flags = opencl_buffer(session, CL_MEM_WRITE_ONLY, most, NULL, error)) &&
           (refinement->list = opencl_buffer(session, CL_MEM_READ_ONLY, most * sizeof(cl_int), NULL, error));
}

void opencl_refinement_free(Refinement *refinement)
{
    free(refinement->read_flags);
    free(refinement->pixels);
    *refinement = (Refinement){0};
}

/* Puts the flagged pixels of the band on the device's list; returns their number, -1 after a failure. */
static long write_list(OpenclSession *session, const Refinement *refinement, Parameters band, RenderReport *report,
                       Error *error)
{
    size_t pixels = (size_t)band.band_rows * (size_t)band.columns;
    if (!opencl_read(session, refinement->flags, pixels, refinement->read_flags, report, error))
        return -1;
    double start = clock_ms();
    long count = 0;
    for (size_t i = 0; i < pixels; i++)
        if (refinement->read_flags[i])
            refinement->pixels[count++] = (cl_int)i;
    cl_int status = CL_SUCCESS;
    if (count > 0)
        status = clEnqueueWriteBuffer(session->queue, refinement->list, CL_TRUE, 0, (size_t)count * sizeof(cl_int),
                                      refinement->pixels, 0, NULL, NULL);
    report->upload_ms += clock_ms() - start;
    return opencl_ok(error, status, "clEnqueueWriteBuffer") ? count : -1;
}

bool opencl_refine(OpenclSession *session, const SceneOnDevice *on_device, cl_kernel kernel,
                   const Refinement *refinement, Parameters band, RenderReport *report, Error *error)
{
    long count = write_list(session, refinement, band, report, error);
    for (long first = 0; first < count; first += OPENCL_MAX_ITEMS) {
        band.refine_first = (int)first;
        band.refine_count = (int)(count - first < OPENCL_MAX_ITEMS ? count - first : OPENCL_MAX_ITEMS);
        if (!opencl_launch(session, on_device, kernel, &band, (size_t)band.refine_count, report, error))
            return false;
    }
    report->refined_pixels += count > 0 ? (uint64_t)count : 0;
    return count >= 0;
}
