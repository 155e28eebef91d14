/* Expands the #include lines of a kernel file. OpenCL compiles texts, not files, so we do what a preprocessor would. */
#include "opencl/opencl_sources.h"

#include "base/text.h"
#include "opencl/kernel_sources.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { MAX_SOURCES = 96, MAX_SOURCE_BYTES = 1 << 20, MAX_NAME = 128, MAX_LINE = 256 };

typedef struct Expansion {
    const char *tree;
    char *text; /* so far; ends in a NUL */
    size_t length, room;
    char done[MAX_SOURCES][MAX_NAME]; /* files that stand in it */
    int done_count;
    Error *error;
} Expansion;

static bool append(Expansion *e, const char *text, size_t length)
{
    if (e->length + length + 1 > e->room) {
        size_t room = 2 * (e->length + length + 1);
        char *grown = realloc(e->text, room);
        if (!grown)
            return error_memory(e->error, "the kernels' text");
        e->text = grown;
        e->room = room;
    }
    memcpy(e->text + e->length, text, length);
    e->length += length;
    e->text[e->length] = '\0';
    return true;
}

/* What follows stands in that line of the file. */
static bool append_place(Expansion *e, int line, const char *name)
{
    char text[MAX_NAME + 32];
    int length = snprintf(text, sizeof text, "#line %d \"%s\"\n", line, name);
    return append(e, text, (size_t)length);
}

/* The text of a file, which the caller frees if it is not *embedded. */
static char *read_file(const char *name, bool *embedded, Error *error)
{
    const char *folder = getenv("RECTRAY_KERNELS");
    *embedded = !folder || !folder[0];
    if (!*embedded) {
        char path[4096];
        long length;
        snprintf(path, sizeof path, "%s/%s", folder, name);
        char *text = text_read(path, MAX_SOURCE_BYTES, &length, error);
        if (!text)
            error->kind = ERROR_SYSTEM; /* not the scene's fault */
        return text;
    }
    for (int i = 0; i < kernel_source_count; i++)
        if (strcmp(kernel_sources[i].name, name) == 0)
            return (char *)(size_t)kernel_sources[i].text;
    error_set(error, ERROR_SYSTEM, "there is no kernel file %s in the program", name);
    return NULL;
}

/* The file that a line of the file `from` includes; false if it is another line. A name without a folder is looked for
 * beside `from`, as in C. */
static bool included_file(const Expansion *e, const char *line, const char *from, char *name)
{
    char word[MAX_LINE];
    line += strspn(line, " \t");
    if (*line != '#')
        return false;
    if (sscanf(line, "# include \"%127[^\"\n]\"", word) == 1) {
        const char *slash = strchr(word, '/') ? NULL : strrchr(from, '/');
        int folder = slash ? (int)(slash - from) + 1 : 0;
        return snprintf(name, MAX_NAME, "%.*s%s", folder, from, word) < MAX_NAME;
    }
    if (sscanf(line, "# include %255s", word) != 1)
        return false;
    const char *form = strcmp(word, "TREE") == 0 ? "packet/%s.cl" : strcmp(word, "BEAM_TREE") == 0 ? "adaptive/beam_%s.cl" : NULL;
    if (form)
        snprintf(name, MAX_NAME, form, e->tree);
    return form != NULL;
}

static bool expand(Expansion *e, const char *name);

static bool expand_lines(Expansion *e, const char *name, const char *text)
{
    if (!append_place(e, 1, name))
        return false;
    int number = 1;
    for (const char *line = text; *line; number++) {
        const char *end = strchr(line, '\n');
        size_t length = end ? (size_t)(end - line) + 1 : strlen(line);
        char included[MAX_NAME];
        bool ok = included_file(e, line, name, included) ? expand(e, included) && append_place(e, number + 1, name)
                                                   : append(e, line, length);
        if (!ok)
            return false;
        line += length;
    }
    return append(e, "\n", 1);
}

static bool expand(Expansion *e, const char *name)
{
    for (int i = 0; i < e->done_count; i++)
        if (strcmp(e->done[i], name) == 0)
            return true;
    if (e->done_count == MAX_SOURCES)
        return error_set(e->error, ERROR_SYSTEM, "the kernels include more than %d files", MAX_SOURCES);
    snprintf(e->done[e->done_count++], MAX_NAME, "%s", name);
    bool embedded;
    char *text = read_file(name, &embedded, e->error);
    bool ok = text && expand_lines(e, name, text);
    if (!embedded)
        free(text);
    return ok;
}

char *opencl_sources(const char *root, const char *tree, Error *error)
{
    Expansion e = {.tree = tree, .error = error};
    if (expand(&e, root))
        return e.text;
    free(e.text);
    return NULL;
}
