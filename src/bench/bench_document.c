/* A page with a place for tables. */
#include "bench/bench_document.h"

#include "base/output.h"
#include "base/text.h"

#include <stdlib.h>
#include <string.h>

enum { DOCUMENT_LIMIT = 16 << 20 };

bool bench_document_read(BenchDocument *document, const char *path, const char *begin, const char *end, Error *error)
{
    long length;
    *document = (BenchDocument){.path = path};
    if (!path)
        return true;
    document->text = text_read(path, DOCUMENT_LIMIT, &length, error);
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
