/* Words, numbers and names of the lines of a text file, in one pass over a block of it (base/text_blocks.h). A line
 * that ends in a backslash goes on in the next one. A comment begins with a '#' at the beginning of a line or after a
 * blank, so that "paint#3" is a name, and ends with its line. */
#ifndef RECTRAY_LINE_SCAN_H
#define RECTRAY_LINE_SCAN_H

#include "base/text.h"

#include <stdbool.h>

typedef struct LineScan {
    char *at;  /* the next character */
    long line; /* the number of its line */
    const char *path;
    Error *error;
    bool bare; /* a failure's message is its reason alone */
} LineScan;

static inline bool scan_is_blank(char c)
{
    return c == ' ' || c == '\t' || c == '\v' || c == '\f';
}

/* Whether no word goes on here. */
static inline bool scan_word_ends(const char *at)
{
    return scan_is_blank(*at) || *at == '\n' || (*at == '\\' && at[1] == '\n');
}

/* Reads a file: calls `read_line` again and again, each time at the beginning of a line, until the file ends or it
 * fails. The scan has the path, the error, and the line 1. False on a failure, also of reading. */
bool scan_file(LineScan *scan, bool (*read_line)(void *user), void *user);

/* Goes to the next word, also on a line that continues this one. */
static inline void scan_blanks(LineScan *scan)
{
    for (;;) {
        while (scan_is_blank(*scan->at))
            scan->at++;
        if (scan->at[0] != '\\' || scan->at[1] != '\n')
            return;
        scan->at += 2;
        scan->line++;
    }
}

/* After scan_blanks: whether there is no further word. */
static inline bool scan_line_ends(const LineScan *scan)
{
    return *scan->at == '\n' || *scan->at == '#';
}

/* Goes to the beginning of the next line that continues none. Always true. */
bool scan_next_line(LineScan *scan);

/* Reads the word here as a number, and goes on past its blanks. A number that no double holds, and what some programs
 * write for it (nan, inf, 1.#IND), are not finite; the caller decides whether that matters. Fails at any other word. */
bool scan_number(LineScan *scan, double *value);

/* Reads numbers up to the end of the line, at most `room`. */
bool scan_numbers(LineScan *scan, double *numbers, int room, int *count);

/* A word of the block. */
typedef struct ScanWord {
    const char *text;
    int length; /* 0: there is none */
} ScanWord;

/* The word here; goes on past its blanks. */
ScanWord scan_word(LineScan *scan);

/* Whether the word is this text, in any case: some programs write capitals. */
bool scan_word_is(ScanWord word, const char *text);

/* The word for a message. */
Quoted scan_quote(ScanWord word);

/* All that is left of the line: a name, which may hold blanks. Goes to the next line. */
char *scan_rest(LineScan *scan);

/* "PATH:LINE: reason", or the reason alone, and false. */
bool scan_fail(const LineScan *scan, long line, const char *format, ...)
#ifdef __GNUC__
    __attribute__((format(printf, 3, 4)))
#endif
    ;

#endif
