/* Expands the #include lines of a kernel file. OpenCL compiles texts, not files, so we do what a preprocessor would. */
#include "opencl/opencl_sources.h"

#include "base/text.h"
#include "opencl/kernel_sources.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { MAX_SOURCES = 96, MAX_SOURCE_BYTES = 1 << 20, MAX_NAME = 128, MAX_LINE = 256 };

typedef struct Expansion {
    const char *tree, *arithmetic;
    char *text; /* so far; ends in a NUL */
    size_t length, room;
    char done[MAX_SOURCES][MAX_NAME]; /* files that stand in it */
    bool open[MAX_SOURCES];           /* of these, the ones that are not at their end */
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

/* A line of a file, from 1. */
typedef struct Place {
    const char *file;
    int line;
} Place;

/* What follows stands there. */
static bool append_place(Expansion *e, Place place)
{
    char text[MAX_NAME + 32];
    int length = snprintf(text, sizeof text, "#line %d \"%s\"\n", place.line, place.file);
    return append(e, text, (size_t)length);
}

/* The folder whose files replace those inside the program, or NULL. */
static const char *folder_of_kernels(void)
{
    const char *folder = getenv("RECTRAY_KERNELS");
    return folder && folder[0] ? folder : NULL;
}

/* A file inside the program, or NULL. */
static const char *embedded_text(const char *name, Error *error)
{
    for (int i = 0; i < kernel_source_count; i++)
        if (strcmp(kernel_sources[i].name, name) == 0)
            return kernel_sources[i].text;
    error_set(error, ERROR_SYSTEM, "there is no kernel file %s in the program", name);
    return NULL;
}

/* A file of the folder, which the caller frees, or NULL. */
static char *folder_text(const char *folder, const char *name, Error *error)
{
    char path[4096];
    long length;
    snprintf(path, sizeof path, "%s/%s", folder, name);
    return text_read(path, MAX_SOURCE_BYTES, &length, error);
}

/* The text of a file; *read is what the caller frees of it. NULL, and what is wrong after the place that includes the
 * file. The root has no such place. */
static const char *text_of(const char *name, Place includer, char **read, Error *error)
{
    const char *folder = folder_of_kernels();
    Error reason = {.kind = ERROR_NONE};
    *read = folder ? folder_text(folder, name, &reason) : NULL;
    const char *text = folder ? *read : embedded_text(name, &reason);
    if (!text && includer.file)
        error_set(error, ERROR_SYSTEM, "%s/%s:%d: %s", folder ? folder : "kernels", includer.file, includer.line,
                  reason.text);
    else if (!text)
        error_set(error, ERROR_SYSTEM, "%s%s", reason.text,
                  folder ? "; RECTRAY_KERNELS must name a folder like kernels/" : "");
    return text;
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
    const char *plain = strcmp(e->arithmetic, OPENCL_PAIRS) == 0 ? OPENCL_PAIRS : "plain";
    const struct {
        const char *word, *form, *choice;
    } choices[] = {
        {"TREE", "packet/%s.cl", e->tree},
        {"BEAM_TREE", "adaptive/beam_%s.cl", e->tree},
        {"PLAIN_TREE", "plain/%s.cl", e->tree},
        {"GPU_TREE", "gpu/%s.cl", e->tree},
        {"ARITHMETIC", "plain/%s_arithmetic.cl", e->arithmetic},
        {"PLAIN", "%s.cl", plain},
        {"FOLLOW", "follow_%s.cl", plain},
    };
    for (size_t i = 0; i < sizeof choices / sizeof *choices; i++)
        if (strcmp(word, choices[i].word) == 0)
            return snprintf(name, MAX_NAME, choices[i].form, choices[i].choice) < MAX_NAME;
    return false;
}

static bool expand(Expansion *e, const char *name, Place includer);

static bool expand_lines(Expansion *e, const char *name, const char *text)
{
    Place place = {name, 1};
    if (!append_place(e, place))
        return false;
    for (const char *line = text; *line; place.line++) {
        const char *end = strchr(line, '\n');
        size_t length = end ? (size_t)(end - line) + 1 : strlen(line);
        char included[MAX_NAME];
        bool ok = included_file(e, line, name, included)
                      ? expand(e, included, place) && append_place(e, (Place){name, place.line + 1})
                      : append(e, line, length);
        if (!ok)
            return false;
        line += length;
    }
    return append(e, "\n", 1);
}

/* The file's place among those that stand in the text; -1: it is not there. */
static int find_done(const Expansion *e, const char *name)
{
    for (int i = 0; i < e->done_count; i++)
        if (strcmp(e->done[i], name) == 0)
            return i;
    return -1;
}

static bool expand(Expansion *e, const char *name, Place includer)
{
    int found = find_done(e, name);
    if (found >= 0 && e->open[found])
        return error_set(e->error, ERROR_SYSTEM, "%s/%s:%d: %s is included in a circle: it leads to this line itself",
                         folder_of_kernels() ? folder_of_kernels() : "kernels", includer.file, includer.line, name);
    if (found >= 0)
        return true;
    if (e->done_count == MAX_SOURCES)
        return error_set(e->error, ERROR_SYSTEM, "the kernels include more than %d files", MAX_SOURCES);
    int place = e->done_count++;
    snprintf(e->done[place], MAX_NAME, "%s", name);
    e->open[place] = true;
    char *read;
    const char *text = text_of(name, includer, &read, e->error);
    bool ok = text && expand_lines(e, name, text);
    free(read);
    e->open[place] = false;
    return ok;
}

char *opencl_sources(const char *root, const char *tree, const char *arithmetic, Error *error)
{
    Expansion e = {.tree = tree, .arithmetic = arithmetic, .error = error};
    if (expand(&e, root, (Place){NULL, 0}))
        return e.text;
    free(e.text);
    return NULL;
}
