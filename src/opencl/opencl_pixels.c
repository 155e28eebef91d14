#include "opencl/opencl_pixels.h"

#include "scene/light.h"

#include <stdlib.h>

/* Bytes of a value on the device. */
static size_t value_bytes(const OpenclSession *session)
{
    return !session->linear ? 1 : session->precision == PRECISION_DOUBLE ? sizeof(double) : sizeof(float);
}

bool opencl_pixels_make(Pixels *pixels, OpenclSession *session, size_t count, double *linear, Error *error)
{
    size_t values = 3 * count, bytes = values * value_bytes(session);
    *pixels = (Pixels){.linear = linear, .device = opencl_buffer(session, CL_MEM_READ_WRITE, bytes, NULL, error)};
    if (!pixels->device)
        return false;
    pixels->read = malloc(bytes);
    pixels->rgb = session->linear ? malloc(values) : pixels->read;
    return (pixels->read && pixels->rgb) || error_memory(error, "a band of the picture");
}

void opencl_pixels_free(Pixels *pixels)
{
    if (pixels->rgb != pixels->read)
        free(pixels->rgb);
    free(pixels->read);
    *pixels = (Pixels){0};
}

Region opencl_pixels_part(const Parameters *band, const Region *region)
{
    int top = band->first_row > region->row ? band->first_row : region->row;
    int band_end = band->first_row + band->band_rows, region_end = region->row + region->rows;
    int end = band_end < region_end ? band_end : region_end;
    return (Region){0, top - region->row, region->columns, end - top};
}

size_t opencl_pixels_bytes(const OpenclSession *session, const Parameters *band)
{
    return (size_t)band->band_rows * (size_t)band->band_columns * 3 * value_bytes(session);
}

void opencl_pixels_take(const Pixels *pixels, const OpenclSession *session, const Region *part)
{
    if (!pixels->linear)
        return;
    double *out = pixels->linear + (size_t)part->row * (size_t)part->columns * 3;
    size_t count = (size_t)part->rows * (size_t)part->columns * 3;
    for (size_t i = 0; i < count; i++) {
        out[i] =
            session->precision == PRECISION_DOUBLE ? ((double *)pixels->read)[i] : (double)((float *)pixels->read)[i];
        pixels->rgb[i] = colour_to_byte(out[i]);
    }
}

bool opencl_pixels_read(const Pixels *pixels, OpenclSession *session, const Parameters *band, const Region *region,
                        RenderReport *report, Error *error)
{
    const Region part = opencl_pixels_part(band, region);
    size_t pixel = 3 * value_bytes(session);
    Rectangle r = {.row_bytes = (size_t)band->band_columns * pixel,
                   .left = (size_t)(region->column - band->first_column) * pixel,
                   .bytes = (size_t)part.columns * pixel,
                   .top = (size_t)(region->row + part.row - band->first_row),
                   .rows = (size_t)part.rows};
    bool whole = r.bytes == r.row_bytes && part.rows == band->band_rows;
    if (whole ? !opencl_read(session, pixels->device, r.rows * r.bytes, pixels->read, report, error)
              : !opencl_read_rectangle(session, pixels->device, r, pixels->read, report, error))
        return false;
    opencl_pixels_take(pixels, session, &part);
    return true;
}
