/* Files of text, opened with care: whole or line by line. */
#include "base/text.h"

#include "base/number.h"

#include <errno.h>
#include <fcntl.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

bool text_fail_errno(const char *path, const char *what, Error *error)
{
    bool user = errno == ENOENT || errno == EACCES || errno == EPERM || errno == EISDIR || errno == ENOTDIR ||
                errno == ENXIO || errno == ELOOP || errno == ENAMETOOLONG;
    int reason = errno;
    Quoted quoted = text_quote(path); /* a path that is too long for the system is too long for a message */
    return error_set(error, user ? ERROR_INPUT : ERROR_SYSTEM, "%s: %s: %s",
                     reason == ENAMETOOLONG ? quoted.text : path, what, strerror(reason));
}

/* O_NONBLOCK: opening a pipe without a writer would wait for ever; for a regular file it means nothing. */
static FILE *open_regular(const char *path, long *size, Error *error)
{
    int descriptor = open(path, O_RDONLY | O_NONBLOCK | O_NOCTTY | O_CLOEXEC);
    if (descriptor < 0) {
        text_fail_errno(path, "cannot be opened", error);
        return NULL;
    }
    struct stat status;
    FILE *file = NULL;
    bool known = fstat(descriptor, &status) == 0;
    if (known && S_ISDIR(status.st_mode))
        error_set(error, ERROR_INPUT, "%s: is a folder, not a file", path);
    else if (known && !S_ISREG(status.st_mode))
        error_set(error, ERROR_INPUT, "%s: is a %s, not a file", path, S_ISFIFO(status.st_mode) ? "pipe" : "device");
    else if (!known || !(file = fdopen(descriptor, "rb")))
        text_fail_errno(path, "cannot be opened", error);
    if (!file)
        close(descriptor);
    *size = (long)status.st_size;
    return file;
}

char *text_read(const char *path, long limit, long *length, Error *error)
{
    long size = 0;
    FILE *file = open_regular(path, &size, error);
    if (!file)
        return NULL;
    char *text = NULL;
    if (size > limit)
        error_set(error, ERROR_INPUT, "%s: is too large: %ld bytes, %ld are allowed", path, size, limit);
    else if (!(text = malloc((size_t)size + 1)))
        error_memory(error, path);
    if (text) {
        *length = (long)fread(text, 1, (size_t)size, file);
        text[*length] = '\0';
        if (ferror(file)) {
            text_fail_errno(path, "cannot be read", error);
            free(text);
            text = NULL;
        }
    }
    fclose(file);
    return text;
}

FILE *text_open(const char *path, Error *error)
{
    long size;
    return open_regular(path, &size, error);
}

bool text_check(const char *path, Error *error)
{
    FILE *file = text_open(path, error);
    if (file)
        fclose(file);
    return file != NULL;
}

bool text_exists(const char *path)
{
    int descriptor = open(path, O_RDONLY | O_NONBLOCK | O_NOCTTY | O_CLOEXEC);
    if (descriptor >= 0)
        close(descriptor);
    return descriptor >= 0 || (errno != ENOENT && errno != ENOTDIR && errno != ENAMETOOLONG);
}

bool text_open_lines(TextLines *lines, const char *path, Error *error)
{
    *lines = (TextLines){.path = path};
    long size = 0;
    lines->buffer = malloc(TEXT_LINE_MAX + 2);
    if (!lines->buffer)
        return error_memory(error, path);
    lines->file = open_regular(path, &size, error);
    return lines->file != NULL;
}

/* Moves the unread rest to the front and fills the buffer up. */
static bool refill(TextLines *lines, Error *error)
{
    memmove(lines->buffer, lines->buffer + lines->begin, lines->end - lines->begin);
    lines->end -= lines->begin;
    lines->begin = 0;
    lines->end += fread(lines->buffer + lines->end, 1, TEXT_LINE_MAX + 1 - lines->end, lines->file);
    if (ferror(lines->file))
        return text_fail_errno(lines->path, "cannot be read", error);
    return true;
}

char *text_next_line(TextLines *lines, Error *error)
{
    char *line = lines->buffer + lines->begin;
    char *stop = memchr(line, '\n', lines->end - lines->begin);
    if (!stop) {
        if (!refill(lines, error) || lines->end == 0)
            return NULL;
        line = lines->buffer;
        stop = memchr(line, '\n', lines->end);
    }
    lines->line++;
    if (!stop && lines->end == TEXT_LINE_MAX + 1) {
        error_set(error, ERROR_INPUT, "%s:%ld: the line is longer than %d bytes", lines->path, lines->line,
                  TEXT_LINE_MAX);
        return NULL;
    }
    if (!stop) /* the last line, without an end */
        stop = lines->buffer + lines->end;
    lines->begin = (size_t)(stop - lines->buffer) + (stop < lines->buffer + lines->end);
    if (lines->line == 1 && stop - line >= 2 && text_is_utf16(line)) {
        error_set(error, ERROR_INPUT, "%s:1: is UTF-16; save it as UTF-8", lines->path);
        return NULL;
    }
    if (memchr(line, '\0', (size_t)(stop - line))) {
        error_set(error, ERROR_INPUT, "%s:%ld: a NUL byte; this is not a text file", lines->path, lines->line);
        return NULL;
    }
    if (stop > line && stop[-1] == '\r')
        stop--;
    *stop = '\0';
    if (lines->line == 1 && strncmp(line, "\xEF\xBB\xBF", 3) == 0) {
        error_set(error, ERROR_INPUT, "%s:1: starts with a byte order mark; save it as UTF-8 without one", lines->path);
        return NULL;
    }
    return line;
}

void text_close_lines(TextLines *lines)
{
    if (lines->file)
        fclose(lines->file);
    free(lines->buffer);
    *lines = (TextLines){0};
}

char *text_beside(const char *path, const char *name, Error *error)
{
    const char *slash = strrchr(path, '/');
    size_t folder = slash && name[0] != '/' ? (size_t)(slash - path) + 1 : 0;
    size_t length = strlen(name);
    char *joined = malloc(folder + length + 1);
    if (!joined) {
        error_memory(error, "a path");
        return NULL;
    }
    memcpy(joined, path, folder);
    memcpy(joined + folder, name, length + 1);
    return joined;
}

char *text_copy(const char *text, Error *error)
{
    char *copy = strdup(text);
    if (!copy)
        error_memory(error, "a name");
    return copy;
}

Quoted text_quote(const char *name)
{
    enum { ROOM = sizeof((Quoted *)0)->text - 6 }; /* two quotes, three dots, the end */
    Quoted quoted;
    size_t length = strlen(name), cut = length;
    if (length > ROOM)
        for (cut = ROOM; cut > 0 && ((unsigned char)name[cut] & 0xC0) == 0x80;) /* not inside a UTF-8 sequence */
            cut--;
    snprintf(quoted.text, sizeof quoted.text, "\"%.*s%s\"", (int)cut, name, cut < length ? "..." : "");
    text_make_utf8(quoted.text);
    for (char *c = quoted.text; *c; c++)
        if ((unsigned char)*c < 0x20 || *c == 0x7F)
            *c = '?';
    return quoted;
}

int text_utf8_length(const char *c)
{
    const unsigned char *u = (const unsigned char *)c;
    int length = u[0] < 0x80 ? 1 : u[0] < 0xC2 ? 0 : u[0] < 0xE0 ? 2 : u[0] < 0xF0 ? 3 : u[0] < 0xF5 ? 4 : 0;
    for (int i = 1; i < length; i++)
        if ((u[i] & 0xC0) != 0x80)
            return 0;
    bool overlong = (u[0] == 0xE0 && u[1] < 0xA0) || (u[0] == 0xF0 && u[1] < 0x90);
    bool surrogate = u[0] == 0xED && u[1] > 0x9F;
    bool beyond = u[0] == 0xF4 && u[1] > 0x8F;
    return overlong || surrogate || beyond ? 0 : length;
}

bool text_is_utf16(const char *text)
{
    return strncmp(text, "\xFF\xFE", 2) == 0 || strncmp(text, "\xFE\xFF", 2) == 0;
}

void text_make_utf8(char *text)
{
    for (int length; *text; text += length) {
        length = text_utf8_length(text);
        if (length == 0) {
            *text = '?';
            length = 1;
        }
    }
}

bool text_number(const char *word, double *value)
{
    const char *end = number_read(word, NUMBER_C, value);
    return end && *end == '\0';
}
