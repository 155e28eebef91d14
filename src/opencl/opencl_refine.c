/* Adaptive sampling on a device. The list of pixels is made here,
 * in a fixed order, so that a picture is the same each time. */
#include "opencl/opencl_refine.h"

#include "base/clock.h"
#include "opencl/opencl_status.h"

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

/* Lists the flagged pixels square by square, so that a work-item's
 * lie near each other and their rays meet the same faces. */
static long list_pixels(const Refinement *refinement, const Parameters *band)
{
    enum { SQUARE = 8 };
    long count = 0;
    for (int top = 0; top < band->band_rows; top += SQUARE)
        for (int left = 0; left < band->band_columns; left += SQUARE)
            for (int row = top; row < top + SQUARE && row < band->band_rows; row++)
                for (int column = left; column < left + SQUARE && column < band->band_columns; column++) {
                    int pixel = row * band->band_columns + column;
                    if (refinement->read_flags[pixel])
                        refinement->pixels[count++] = pixel;
                }
    return count;
}

/* Puts the flagged pixels of the band on the device's list; returns their number, -1 after a failure. */
static long write_list(OpenclSession *session, const Refinement *refinement, Parameters band, RenderReport *report,
                       Error *error)
{
    size_t pixels = (size_t)band.band_rows * (size_t)band.band_columns;
    if (!opencl_read(session, refinement->flags, pixels, refinement->read_flags, report, error))
        return -1;
    double start = clock_ms();
    long count = list_pixels(refinement, &band);
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
    /* A work-item refines a pixel with each of its packets. */
    const int each = session->packets_across * session->packets_across;
    const long most = (long)OPENCL_MAX_ITEMS * each;
    for (long first = 0; first < count; first += most) {
        band.refine_first = (int)first;
        band.refine_count = (int)(count - first < most ? count - first : most);
        if (!opencl_launch(session, on_device, kernel, &band, (size_t)((band.refine_count + each - 1) / each), report,
                           error))
            return false;
    }
    report->refined_pixels += count > 0 ? (uint64_t)count : 0;
    return count >= 0;
}
