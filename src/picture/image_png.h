/* Writing PNG files, row by row, into a file that is open. */
#ifndef RECTRAY_IMAGE_PNG_H
#define RECTRAY_IMAGE_PNG_H

#include "base/output.h"

typedef struct PngWriter PngWriter;

/* Begins a picture of RGB with 8 or 16 bits a channel. NULL, with the error filled, where the file cannot be written or
 * memory is out. The output must outlive the writer. `part`: the
 * text for the chunk of a part, part_note.h; NULL: there is none. */
PngWriter *png_writer_open(Output *output, int columns, int rows, int depth, const char *part, Error *error);

/* Adds rows from the top; of 16 bits the most significant byte comes first. */
bool png_writer_rows(PngWriter *writer, const unsigned char *rgb, int rows, Error *error);

/* All rows are there: writes the end. */
bool png_writer_end(PngWriter *writer, Error *error);

/* Frees the writer, which may be NULL. */
void png_writer_free(PngWriter *writer);

#endif
