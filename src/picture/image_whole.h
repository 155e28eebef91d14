/* Whether a picture is there, whole, and of the right size: so that a run that was stopped goes on where it was. */
#ifndef RECTRAY_IMAGE_WHOLE_H
#define RECTRAY_IMAGE_WHOLE_H

#include "picture/image.h"

/* Whether the file is a picture of that kind and size from its first byte to its last: a PNG whose chunks follow one
 * another to the end of the file, each with its checksum, a PPM or PFM of exactly as many bytes as it needs, which have
 * no checksum. What is not a file, a pipe say, is no picture that is there. */
bool image_is_whole(const char *path, ImageKind kind, int columns, int rows);

#endif
