/* A user's mistake, or a failing machine, as a value.
 * Functions that can fail return false and fill an Error; only main turns it into an exit status.
 * A programmer's mistake is an assert, never an Error. */
#ifndef RECTRAY_ERROR_H
#define RECTRAY_ERROR_H

#include <stdbool.h>

/* The values are the program's exit statuses. */
typedef enum ErrorKind {
    ERROR_NONE = 0,
    ERROR_INPUT = 1,  /* the scene or another input is wrong */
    ERROR_USAGE = 2,  /* the command line is wrong */
    ERROR_SYSTEM = 3, /* the device, memory or file system failed */
} ErrorKind;

typedef struct Error {
    ErrorKind kind;
    char text[8192]; /* one message without a final newline; a compiler's log may follow in it */
} Error;

/* Fills the error, printf-like, and returns false, so that a function can `return error_set(...)`.
 * A message that does not fit is cut at a character and ends in "..."; control characters other than newline and tab
 * become question marks. The first error stays: a later one does not hide it. */
bool error_set(Error *error, ErrorKind kind, const char *format, ...)
#ifdef __GNUC__
    __attribute__((format(printf, 3, 4)))
#endif
    ;

/* "out of memory (WHAT)", as ERROR_SYSTEM. */
bool error_memory(Error *error, const char *what);

#endif
