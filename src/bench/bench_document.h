/* A page of docs/ with a place for tables between two marked lines; all its other words stay. */
#ifndef RECTRAY_BENCH_DOCUMENT_H
#define RECTRAY_BENCH_DOCUMENT_H

#include "base/error.h"

#include <stdio.h>

typedef struct BenchDocument {
    const char *path;
    char *text; /* NULL: none is wanted, the tables are printed */
    char *begin, *end;
} BenchDocument;

/* Reads the page and finds the marks: two whole lines, each with its newline. A NULL path and "-", standard output,
 * want none. A page that is not there will be made, with the marks. One without marks, or that cannot be made, is an
 * error, to be told before anything is measured. */
bool bench_document_read(BenchDocument *document, const char *path, const char *begin, const char *end, Error *error);

/* Replaces what is between the marks by what `print` writes. */
bool bench_document_write(const BenchDocument *document, void (*print)(FILE *out, const void *data), const void *data,
                          Error *error);

void bench_document_free(BenchDocument *document);

#endif
