/* An output file that appears under its name only when it is complete: until then it has a temporary name in the
 * same folder. It is not forced to the disk (fsync): a rename is whole after any crash of the program; after a power
 * cut the file system decides. */
#ifndef RECTRAY_OUTPUT_H
#define RECTRAY_OUTPUT_H

#include "base/error.h"

#include <stdio.h>

typedef struct Output {
    FILE *file;       /* to write to; NULL after commit and abort */
    const char *what; /* as messages call it where it goes to standard output, such as "the picture" */
    char *path;       /* as messages name it */
    char *target;     /* what the temporary file will be called: the path with its links followed */
    char *temporary;  /* NULL where the output is written in place: stdout, a device, a pipe */
} Output;

/* Whether writing to `path` would replace the file `input`: a
 * slip of the hand, `-o scene.json`, must not cost the scene. */
bool output_replaces(const char *path, const char *input);

/* Opens the path: "-" is standard output, a device or a pipe is written to as it
 * is, a file is replaced when all is written. False with an ERROR_SYSTEM that names
 * the file where that is not possible: a folder, no right, marked read-only. */
bool output_open(Output *output, const char *path, const char *what, Error *error);

/* Closes the file and gives it its name. False with an ERROR_SYSTEM if anything written to it was lost; then what was
 * under the name is as it was. Frees the output either way. */
bool output_commit(Output *output, Error *error);

/* Leaves what was under the name as it was; frees and zeroes the output, which may be zeroed already. */
void output_abort(Output *output);

/* Removes from the folder of `path` what processes that were killed have left there under temporary names. A file that
 * is still being written is locked by its writer, and stays; on a file system without locks all stay. */
void output_sweep(const char *path);

/* Fills the error: "cannot write PATH: reason". Returns false. */
bool output_failed(const Output *output, const char *reason, Error *error);

#endif
