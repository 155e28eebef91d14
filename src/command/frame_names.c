/* The user's pattern never reaches printf: it is read here, and only what is meant is written. */
#include "command/frame_names.h"

#include "base/number.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { MOST_DIGITS = 9 };

/* The end of "%d" or "%0Nd", with N from 1 to 9, and N; NULL where there is something else. */
static const char *read_number(const char *at, int *digits)
{
    *digits = 1;
    at++;
    if (at[0] == '0' && at[1] >= '1' && at[1] <= '0' + MOST_DIGITS) {
        *digits = at[1] - '0';
        at += 2;
    }
    return *at == 'd' ? at + 1 : NULL;
}

bool frame_names_check(const char *pattern, Error *error)
{
    int numbers = 0, digits;
    for (const char *at = strchr(pattern, '%'); at; at = strchr(at, '%')) {
        const char *end = at[1] == '%' ? at + 2 : read_number(at, &digits);
        if (!end)
            return error_set(error, ERROR_USAGE,
                             "-o '%s': %.2s is no number of a frame; write %%04d for four digits, or %%%% for a "
                             "percent sign",
                             pattern, at);
        numbers += at[1] != '%';
        at = end;
    }
    if (numbers == 0)
        return error_set(error, ERROR_USAGE,
                         "-o '%s' names one file for all frames; put %%04d where the number of the frame is to be, as "
                         "in 'frame-%%04d.png', or end it in .mp4, .webm or .gif for a film",
                         pattern);
    return numbers == 1 || error_set(error, ERROR_USAGE, "-o '%s' has the number of the frame twice", pattern);
}

char *frame_name(const char *pattern, int frame, Error *error)
{
    size_t size = strlen(pattern) + MOST_DIGITS + 8, used = 0;
    char *name = malloc(size);
    if (!name)
        error_memory(error, "the name of a frame");
    for (const char *at = pattern; name && *at;) {
        int digits;
        if (*at != '%') {
            name[used++] = *at++;
        } else if (at[1] == '%') {
            name[used++] = '%';
            at += 2;
        } else {
            at = read_number(at, &digits);
            used += (size_t)snprintf(name + used, size - used, "%0*d", digits, frame);
        }
    }
    if (name)
        name[used] = '\0';
    return name;
}
