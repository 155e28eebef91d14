/* Files of text, opened with care: whole or line by line; and small services for messages about them.
 * Only regular files are read, so that a folder, a pipe or a device is an answer and not a hang. The exception is
 * text_read_input, for what a user names as the program's input. */
#ifndef RECTRAY_TEXT_H
#define RECTRAY_TEXT_H

#include "base/error.h"

#include <stddef.h>
#include <stdio.h>

/* "PATH: WHAT: reason of errno", and false. A wrong path is the user's mistake (ERROR_INPUT); a failing disk, no memory
 * or a full table of files is the system's. */
bool text_fail_errno(const char *path, const char *what, Error *error);

enum { TEXT_LINE_MAX = 65535 }; /* the longest line that text_next_line reads, in bytes */

/* Reads a regular file of up to `limit` bytes. The text ends in a NUL that *length does not count; the caller frees it.
 * NULL, with "PATH: reason": missing, a folder, not a regular file, unreadable, too large, no memory. */
char *text_read(const char *path, long limit, long *length, Error *error);

/* The same, and besides: "-" is standard input, and a pipe is read to its end. */
char *text_read_input(const char *path, long limit, long *length, Error *error);

/* Whether such an input can be read only once: standard input, or a pipe. */
bool text_is_stream(const char *path);

/* What messages call such an input: "<stdin>", or its path. */
const char *text_input_name(const char *path);

/* Opens a regular file to read; the errors are those of text_read, but any size will do. NULL on failure. */
FILE *text_open(const char *path, Error *error);

/* Whether the path is a regular file that can be opened; the errors are those of text_read, but any size will do. */
bool text_check(const char *path, Error *error);

/* Whether anything has that name, be it a folder or a file that cannot be read. */
bool text_exists(const char *path);

typedef struct TextLines {
    FILE *file;
    const char *path; /* borrowed */
    long line;        /* number of the line last returned, from 1 */
    size_t begin, end;
    char *buffer;
} TextLines;

/* Opens a regular file to read line by line; errors as for text_check. */
bool text_open_lines(TextLines *lines, const char *path, Error *error);

/* The next line without its end (LF or CRLF), valid until the next call. NULL at the end of the file, and on an error:
 * a line longer than TEXT_LINE_MAX, a NUL byte, a byte order mark, a failing read. */
char *text_next_line(TextLines *lines, Error *error);

void text_close_lines(TextLines *lines);

/* The path of `name` as seen from the folder of the file `path`; an absolute name stays. NULL without memory. */
char *text_beside(const char *path, const char *name, Error *error);

/* strdup, with the error filled. */
char *text_copy(const char *text, Error *error);

/* A name for a message: in double quotes, cut to some 60 characters, without control characters. */
typedef struct Quoted {
    char text[80];
} Quoted;

Quoted text_quote(const char *name);

/* Bytes of the UTF-8 sequence at `c`; 0 if it is none (Unicode standard, table 3-7). */
int text_utf8_length(const char *c);

/* Whether a text begins with the byte order mark of UTF-16, as some editors' "Unicode" does. */
bool text_is_utf16(const char *text);

/* Replaces each byte that is no part of UTF-8 by '?': a file's name and a word of a model may be any bytes, but JSON,
 * SVG and terminals want UTF-8. */
void text_make_utf8(char *text);

/* A decimal number as C prints them (1, -1.5, .5, 1., 2e-3),
 * all of the word and finite; not hexadecimal, inf or nan. */
bool text_number(const char *word, double *value);

#endif
