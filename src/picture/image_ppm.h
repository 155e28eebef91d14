/* Reading PPM files, the "P6" of Netpbm: https://netpbm.sourceforge.net/doc/ppm.html. */
#ifndef RECTRAY_IMAGE_PPM_H
#define RECTRAY_IMAGE_PPM_H

#include "picture/image.h"

#include <stdio.h>

/* Reads what follows "P6". Values are scaled to 8 bits. Errors are those of image_read. */
bool image_ppm_read(Image *image, FILE *file, const char *path, Error *error);

#endif
