/* A page with a place for tables. */
#include "bench/bench_document.h"

#include "base/output.h"
#include "base/text.h"

#include <stdlib.h>
#include <string.h>

enum { DOCUMENT_LIMIT = 16 << 20 };

/* Whether a file can be made there. Nothing stays of the attempt. */
static bool is_writable(const char *path, Error *error)
{
    Output output;
    if (!output_open(&output, path, "the page", error))
        return false;
    output_abort(&output);
    return true;
}

/* A page of the two marks alone. */
static char *new_page(const char *path, const char *begin, const char *end, Error *error)
{
    if (!is_writable(path, error))
        return NULL;
    size_t size = strlen(begin) + strlen(end) + 1;
    char *text = malloc(size);
    if (text)
        snprintf(text, size, "%s%s", begin, end);
    else
        error_memory(error, "the page");
    return text;
}

bool bench_document_read(BenchDocument *document, const char *path, const char *begin, const char *end, Error *error)
{
    long length;
    *document = (BenchDocument){.path = path};
    if (!path || strcmp(path, "-") == 0)
        return true;
    document->text =
        text_exists(path) ? text_read(path, DOCUMENT_LIMIT, &length, error) : new_page(path, begin, end, error);
    if (!document->text)
        return false;
    char *mark = strstr(document->text, begin);
    document->begin = mark ? mark + strlen(begin) : NULL;
    document->end = mark ? strstr(document->begin, end) : NULL;
    return document->end || error_set(error, ERROR_INPUT, "%s: the lines %.*s and %.*s are missing", path,
                                      (int)strlen(begin) - 1, begin, (int)strlen(end) - 1, end);
}

bool bench_document_write(const BenchDocument *document, void (*print)(FILE *out, const void *data), const void *data,
                          Error *error)
{
    Output output;
    if (!output_open(&output, document->path, "the page", error))
        return false;
    fwrite(document->text, 1, (size_t)(document->begin - document->text), output.file);
    print(output.file, data);
    fputs(document->end, output.file);
    return output_commit(&output, error);
}

void bench_document_free(BenchDocument *document)
{
    free(document->text);
    document->text = NULL;
}
