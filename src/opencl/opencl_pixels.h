/* The pixels of a band on their way from the device: bytes, or reals where linear colours are wanted. */
#ifndef RECTRAY_OPENCL_PIXELS_H
#define RECTRAY_OPENCL_PIXELS_H

#include "opencl/opencl_upload.h"

typedef struct Pixels {
    cl_mem device;      /* the band, as the kernel writes it */
    void *read;         /* the part of it that is wanted: bytes, or reals of the session's precision */
    unsigned char *rgb; /* the same in bytes; where `read` has bytes, it is `read` */
    double *linear;     /* the whole region's, or NULL */
} Pixels;

/* Room for `count` pixels, here and on the device. Free it also after a failure, before the session is closed. */
bool opencl_pixels_make(Pixels *pixels, OpenclSession *session, size_t count, double *linear, Error *error);
void opencl_pixels_free(Pixels *pixels);

/* The rows of the band that are in the region; `row` and `column` count from the region's corner. */
Region opencl_pixels_part(const Parameters *band, const Region *region);

/* Bytes of a band on the device. */
size_t opencl_pixels_bytes(const OpenclSession *session, const Parameters *band);

/* Makes bytes, and keeps the linear colours, of a part of the region that was read. */
void opencl_pixels_take(const Pixels *pixels, const OpenclSession *session, const Region *part);

/* Reads that part of the band into pixels->rgb, and into pixels->linear where linear colours are wanted. */
bool opencl_pixels_read(const Pixels *pixels, OpenclSession *session, const Parameters *band, const Region *region,
                        RenderReport *report, Error *error);

#endif
