/* Files of text in large blocks of whole lines, so that a reader goes through the bytes once and a model of ten million
 * faces needs no copy of its text. */
#ifndef RECTRAY_TEXT_BLOCKS_H
#define RECTRAY_TEXT_BLOCKS_H

#include "base/error.h"

#include <stdio.h>

enum { TEXT_BLOCK_MAX = 1048576 }; /* the longest line, with those that it is continued on, in bytes */

typedef struct TextBlocks {
    FILE *file;
    const char *path; /* borrowed */
    char *buffer;
    char *rest;        /* what follows the block last given */
    long rest_length;  /* of it */
    long clean_length; /* of it: without NUL bytes and carriage returns */
    long line;         /* the number of lines that are done, which the reader keeps */
    bool begun, ended;
} TextBlocks;

/* Opens a regular file; errors as for text_check. */
bool text_blocks_open(TextBlocks *blocks, const char *path, Error *error);

/* Whole lines, from `at` to `end`. */
typedef struct TextBlock {
    char *at, *end;
} TextBlock;

/* The next block, valid until the next call. It ends with a line, and never between a line that ends in a backslash and
 * the one that continues it. Ends of lines are '\n' whatever they were in the file: CR LF is " \n", a CR alone "\n". A
 * byte order mark is left out. An empty block at the end of the file, and on an error: a line longer than
 * TEXT_BLOCK_MAX, UTF-16, a NUL byte, a failing read. */
TextBlock text_blocks_next(TextBlocks *blocks, Error *error);

void text_blocks_close(TextBlocks *blocks);

#endif
