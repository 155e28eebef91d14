/* Pictures as PNG files, through libpng: written row by row as they are rendered, a quarter of a megabyte being held at
 * a time; read whole for comparing.
 * A picture appears under its name only when it is complete:
 * until then it has a temporary name in the same folder. */
#ifndef RECTRAY_IMAGE_H
#define RECTRAY_IMAGE_H

#include "base/error.h"

enum { IMAGE_MAX_SIDE = 16384 }; /* columns, rows */

typedef struct ImageWriter ImageWriter;

/* Opens a picture of RGB, 8 bits each, for writing; NULL with an ERROR_SYSTEM that names the file where that is not
 * possible, so that nobody renders for an hour first. The path "-" is stdout; a device or pipe is written to as it is.
 * The same rows give the same bytes, however they come; no date goes in. */
ImageWriter *image_writer_open(const char *path, int columns, int rows, Error *error);

/* Adds `rows` rows from the top, 3 * columns bytes each. After a failure only abort is left. */
bool image_writer_rows(ImageWriter *writer, const unsigned char *rgb, int rows, Error *error);

/* All rows are there: completes the picture, gives it its name and frees the writer, also where that fails. */
bool image_writer_commit(ImageWriter *writer, Error *error);

/* Leaves what was under the picture's name as it was and frees the writer, which may be NULL. */
void image_writer_abort(ImageWriter *writer);

typedef struct Image {
    int columns, rows;
    unsigned char *rgb; /* rows * columns * 3 */
} Image;

/* Reads a PNG of any kind as RGB, 8 bits each: 16 bits are scaled, grey and palette expanded, transparency is
 * left out. Errors: no such file, not a PNG or a damaged one, larger than IMAGE_MAX_SIDE (ERROR_INPUT), memory. */
bool image_read(Image *image, const char *path, Error *error);

/* Frees the pixels and zeroes the image. */
void image_free(Image *image);

/* Writes a whole image. */
bool image_write(const Image *image, const char *path, Error *error);

#endif
