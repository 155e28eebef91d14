/* Pictures in linear colours, before they are clamped to [0, 1] and rounded: as portable float maps (PFM), and as rows
 * of whole numbers. The PFM of Debevec: http://www.pauldebevec.com/Research/HDR/PFM/. */
#ifndef RECTRAY_IMAGE_LINEAR_H
#define RECTRAY_IMAGE_LINEAR_H

#include "base/error.h"

#include <stdio.h>

typedef struct LinearImage {
    int columns, rows;
    float *rgb; /* rows * columns * 3, from the top; 1 is full strength */
} LinearImage;

/* Whether a file begins as a PFM does. One that cannot be read does not, nor does a pipe. */
bool image_is_pfm(const char *path);

/* Reads a PFM in colour, of either order of bytes; its rows come from the bottom. Errors: those of image_read. */
bool image_linear_read(LinearImage *image, const char *path, Error *error);

/* Writes rows * columns * 3 linear colours, from the top, as a PFM: floats, the least significant byte first. False,
 * with errno, where the file cannot be written or memory is out. */
bool image_linear_write(FILE *file, const double *rgb, int columns, int rows);

/* Frees the pixels and zeroes the image. */
void image_linear_free(LinearImage *image);

/* One linear colour as a whole number of 16 bits: clamped to [0, 1], times 65535, rounded. */
unsigned image_to_16_bits(double value);

#endif
