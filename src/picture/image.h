/* Pictures as PNG files, through libpng, and as PPM: written row by row as they are rendered, a quarter of a megabyte
 * being held at a time; read whole for comparing. Linear colours are in image_linear.h.
 * A picture appears under its name only when it is complete:
 * until then it has a temporary name in the same folder. */
#ifndef RECTRAY_IMAGE_H
#define RECTRAY_IMAGE_H

#include "picture/image_format.h"

#include <stddef.h>

enum { IMAGE_MAX_SIDE = 16384 }; /* columns, rows */

typedef struct ImageWriter ImageWriter;

typedef struct ImageKind {
    ImageFormat format;
    int depth;        /* bits a channel, 8 or 16 */
    const char *part; /* of a PNG that is a part of a picture: its note, part_note.h; else NULL */
} ImageKind;

/* Opens a picture of RGB, 8 bits each, for writing, in the format that the path's ending names. NULL, so that nobody
 * renders for an hour first: with an ERROR_SYSTEM that names the file where it cannot be written, with an ERROR_USAGE
 * for another ending. The path "-" is stdout; a device or pipe is written to as it is. The same rows give the same
 * bytes, however they come; no date goes in. */
ImageWriter *image_writer_open(const char *path, int columns, int rows, Error *error);

/* The same in a given format, with 8 or 16 bits a channel. A PFM, and what has 16 bits, may be written by
 * image_writer_linear instead of by rows. */
ImageWriter *image_writer_open_as(const char *path, ImageKind kind, int columns, int rows, Error *error);

/* Adds `rows` rows from the top, 3 * columns bytes each, or twice as many of 16 bits, the most significant byte first.
 * After a failure only abort is left. */
bool image_writer_rows(ImageWriter *writer, const unsigned char *rgb, int rows, Error *error);

/* Writes the whole picture from rows * columns * 3 linear colours: as they are into a PFM, else clamped to [0, 1] and
 * rounded to 16 bits. Instead of image_writer_rows. */
bool image_writer_linear(ImageWriter *writer, const double *rgb, Error *error);

/* All rows are there: completes the picture, gives it its name and frees the writer, also where that fails. */
bool image_writer_commit(ImageWriter *writer, Error *error);

/* Leaves what was under the picture's name as it was and frees the writer, which may be NULL. */
void image_writer_abort(ImageWriter *writer);

typedef struct Image {
    int columns, rows;
    unsigned char *rgb; /* rows * columns * 3 */
} Image;

/* Reads a PNG of any kind, or a PPM, as RGB, 8 bits each: 16 bits are scaled, grey and palette expanded, transparency
 * is left out. Errors: no such file, neither PNG nor PPM or a damaged one, larger than IMAGE_MAX_SIDE (ERROR_INPUT),
 * memory. */
bool image_read(Image *image, const char *path, Error *error);

/* Frees the pixels and zeroes the image. */
void image_free(Image *image);

/* Writes a whole image. */
bool image_write(const Image *image, const char *path, Error *error);

/* The PNG of a whole image in memory. *png, NULL before, is the caller's to free, also after a failure. */
bool image_encode(const Image *image, char **png, size_t *size, Error *error);

#endif
