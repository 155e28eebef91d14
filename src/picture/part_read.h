/* Reads the files of parts, row by row, so that no picture is ever in memory. */
#ifndef RECTRAY_PART_READ_H
#define RECTRAY_PART_READ_H

#include "base/error.h"
#include "picture/part_note.h"

typedef struct PartReader PartReader;

typedef struct PartFile {
    PartNote note;
    int columns, rows;
    int depth; /* bits a channel, 8 or 16 */
} PartFile;

/* Opens the file and tells what it holds. NULL with an ERROR_INPUT that names the file, and the cure where it is no
 * part. */
PartReader *part_reader_open(const char *path, PartFile *file, Error *error);

/* Reads the next row into `row`: 3 * columns bytes, or twice as many of 16 bits, the most significant byte first. False
 * with an ERROR_INPUT where the file is damaged. */
bool part_reader_row(PartReader *reader, unsigned char *row, Error *error);

/* NULL is allowed. */
void part_reader_close(PartReader *reader);

#endif
