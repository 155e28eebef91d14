/* JSON with places: cJSON's tree, read strictly, and errors that say file, line, column, path and reason.
 * cJSON is lenient (007, text after the end, repeated keys) and keeps no places. So the text is first scanned
 * by the grammar of RFC 8259, and a place is looked up only when an error needs it: the tree keeps the order of the
 * text, so the n-th value of the one is the n-th value of the other. */
#ifndef RECTRAY_JSON_H
#define RECTRAY_JSON_H

#include "base/error.h"

#include <cjson/cJSON.h>

enum { JSON_MAX_BYTES = 1073741824 }; /* of a file: 1 GiB */

typedef struct Json {
    const char *name; /* of the file, for messages; borrowed */
    char *text;
    long length;
    cJSON *root;
    Error *error; /* borrowed; where json_fail writes */
} Json;

/* Reads and parses a file, a pipe, or with "-" standard input. Errors (ERROR_INPUT): those of text_read_input; a syntax
 * error, also a byte order mark, a NUL, bytes that are not UTF-8, a number out of a double's range; a key that stands
 * twice in an object. Frees what it had on failure. */
bool json_load(Json *json, const char *path, Error *error);

/* The same for a text in memory, which is copied. `name` stands for the path in messages. */
bool json_parse(Json *json, const char *name, const char *text, long length, Error *error);

/* The same for a text on the heap that ends in a NUL, which json_free frees, or a failure does. */
bool json_take(Json *json, const char *name, char *text, long length, Error *error);

void json_free(Json *json);

/* Fills the error with "NAME:LINE:COLUMN: PATH: reason", then the line and a caret under the place. Line and column
 * count from 1, a column is a character. `item` is a value of the tree. Returns false. */
bool json_fail(const Json *json, const cJSON *item, const char *format, ...)
#ifdef __GNUC__
    __attribute__((format(printf, 3, 4)))
#endif
    ;

/* The same, with the place of the value's key. */
bool json_fail_key(const Json *json, const cJSON *item, const char *format, ...)
#ifdef __GNUC__
    __attribute__((format(printf, 3, 4)))
#endif
    ;

/* A value's place, for what is told about it without an error. Looks through the text up to there. */
typedef struct JsonPlace {
    long line, column;
    char path[256]; /* objects[2].faces[0] */
} JsonPlace;

JsonPlace json_place(const Json *json, const cJSON *item);

#endif
