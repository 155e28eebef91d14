/* Whether a picture is there, whole, and of the right size: so that a run that was stopped goes on where it was. */
#ifndef RECTRAY_IMAGE_WHOLE_H
#define RECTRAY_IMAGE_WHOLE_H

#include "picture/image.h"

/* Whether the file is a picture of that kind and size from its first byte to its last: a PNG whose chunks follow one
 * another to the end of the file, a PPM or PFM of exactly the bytes that it needs. The pixels are not looked at. */
bool image_is_whole(const char *path, ImageKind kind, int columns, int rows);

#endif
