/* A user's mistake, or a failing machine, as a value. */
#include "error.h"

#include <stdarg.h>
#include <stdio.h>
#include <string.h>

bool error_set(Error *error, ErrorKind kind, const char *format, ...)
{
    if (error->kind != ERROR_NONE)
        return false;
    error->kind = kind;
    va_list arguments;
    va_start(arguments, format);
    int length = vsnprintf(error->text, sizeof error->text, format, arguments);
    va_end(arguments);
    if (length >= (int)sizeof error->text) {
        char *end = error->text + sizeof error->text - 4;
        while (((unsigned char)*end & 0xC0) == 0x80) /* not inside a UTF-8 sequence */
            end--;
        strcpy(end, "...");
    }
    return false;
}

bool error_memory(Error *error, const char *what) { return error_set(error, ERROR_SYSTEM, "out of memory (%s)", what); }
