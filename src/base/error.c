/* A user's mistake, or a failing machine, as a value. */
#include "base/error.h"

#include <stdarg.h>
#include <stdio.h>
#include <string.h>

/* A name in a message must not steer the terminal: control characters (C0 but newline and tab, DEL, C1) become '?'. */
static void disarm(char *text)
{
    for (unsigned char *c = (unsigned char *)text; *c; c++)
        if ((*c < 0x20 && *c != '\n' && *c != '\t') || *c == 0x7F)
            *c = '?';
        else if (c[0] == 0xC2 && c[1] >= 0x80 && c[1] < 0xA0)
            c[0] = c[1] = '?';
}

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
    disarm(error->text);
    return false;
}

bool error_memory(Error *error, const char *what)
{
    return error_set(error, ERROR_SYSTEM, "out of memory (%s)", what);
}
