/* Texts that a user names as the program's input: files, pipes, standard input. */
#include "base/text.h"

#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

/* Whether a file, redirected to standard input, tells that more is left of it: then none of it need be read. */
static bool is_surely_larger(FILE *file, long limit)
{
    struct stat status;
    int number = fileno(file);
    return fstat(number, &status) == 0 && S_ISREG(status.st_mode) && status.st_size - ftello(file) > limit;
}

/* Reads to the end of a pipe, whose length nobody knows: the memory doubles as it fills. */
static char *read_stream(FILE *file, const char *name, long limit, long *length, Error *error)
{
    long capacity = limit < 1 << 16 ? limit + 1 : 1 << 16, filled = 0;
    bool is_large = is_surely_larger(file, limit);
    char *text = is_large ? NULL : malloc((size_t)capacity + 1);
    while (text) {
        filled += (long)fread(text + filled, 1, (size_t)(capacity - filled), file);
        is_large = filled > limit;
        if (filled < capacity || is_large)
            break;
        capacity = capacity > limit / 2 ? limit + 1 : 2 * capacity;
        char *grown = realloc(text, (size_t)capacity + 1);
        if (!grown)
            free(text);
        text = grown;
    }
    if (is_large) {
        error_set(error, ERROR_INPUT, "%s: is too large: more than %ld bytes", name, limit);
        free(text);
        return NULL;
    }
    if (!text) {
        error_memory(error, name);
        return NULL;
    }
    if (ferror(file)) {
        text_fail_errno(name, "cannot be read", error);
        free(text);
        return NULL;
    }
    text[filled] = '\0';
    *length = filled;
    return text;
}

static bool is_pipe(const char *path)
{
    struct stat status;
    return stat(path, &status) == 0 && S_ISFIFO(status.st_mode);
}

bool text_is_stream(const char *path)
{
    return strcmp(path, "-") == 0 || is_pipe(path);
}

const char *text_input_name(const char *path)
{
    return strcmp(path, "-") == 0 ? "<stdin>" : path;
}

char *text_read_input(const char *path, long limit, long *length, Error *error)
{
    bool is_stdin = strcmp(path, "-") == 0;
    if (!is_stdin && !is_pipe(path))
        return text_read(path, limit, length, error);
    FILE *file = is_stdin ? stdin : fopen(path, "rb"); /* waits until someone writes */
    if (!file) {
        text_fail_errno(path, "cannot be opened", error);
        return NULL;
    }
    char *text = read_stream(file, text_input_name(path), limit, length, error);
    if (!is_stdin)
        fclose(file);
    return text;
}
