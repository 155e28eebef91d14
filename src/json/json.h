/* JSON with places: cJSON's tree, read strictly, and errors that say file, line, column, path and reason.
 * cJSON is lenient (007, text after the end, repeated keys) and keeps no places. So the text is first scanned
 * by the grammar of RFC 8259, and a place is looked up only when an error needs it: the tree keeps the order of the
 * text, so the n-th value of the one is the n-th value of the other. */
#ifndef RECTRAY_JSON_H
#define RECTRAY_JSON_H

#include "base/error.h"
#include "json/json_bulk.h"

#include <cjson/cJSON.h>

enum { JSON_MAX_BYTES = 1073741824 }; /* of a file: 1 GiB */

/* The insides of lists that are left out of a tree, in the order of the text. The tree of a large file takes many times
 * its time and memory, and most of that are the elements of few lists. The tree has such a list with a mark only, and
 * the elements stay in the text. One that is needed gets a tree of its own. Its errors have their place in the file. */
typedef struct JsonCuts {
    JsonSpan *spans;
    int count;
} JsonCuts;

typedef struct Json {
    const char *name; /* of the file, for messages; borrowed */
    char *text;
    long length;
    cJSON *root;
    const char *begin; /* of the root's value in the text */
    Error *error;      /* borrowed; where json_fail writes */
    JsonCuts cuts;
    const struct Json *whole; /* of an element with a tree of its own: whose text it is, */
    const cJSON *list;        /* the list there, */
    int index;                /* and which element. NULL: none */
} Json;

/* Reads and parses a file, a pipe, or with "-" standard input. Errors (ERROR_INPUT): those of text_read_input; a syntax
 * error, also a byte order mark, a NUL, bytes that are not UTF-8, a number out of a double's range; a key that stands
 * twice in an object. Frees what it had on failure. */
bool json_load(Json *json, const char *path, Error *error);

/* The same for a text in memory, which is copied. `name` stands for the path in messages. */
bool json_parse(Json *json, const char *name, const char *text, long length, Error *error);

/* The same for a text on the heap that ends in a NUL, which json_free frees, or a failure does. */
bool json_take(Json *json, const char *name, char *text, long length, Error *error);

/* The same without the insides of some lists: what stands between their brackets, of which none is in another one.
 * Takes over the spans, too. */
bool json_take_cut(Json *json, const char *name, char *text, long length, JsonCuts cuts, Error *error);

/* Whether a list was cut, and its inside. */
bool json_is_cut(const Json *json, const cJSON *list, JsonSpan *inside);

/* The element of a cut list that begins at `at`. json_free frees it; the text stays the whole's. False without memory.
 */
bool json_take_element(Json *element, const Json *whole, const cJSON *list, const char *at, int index);

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

/* The same for a place in the text: "" is no path. */
bool json_fail_at(const Json *json, const char *place, const char *path, const char *reason);

/* For json.c: makes the tree of a text that json_scan accepts; false without memory. */
bool json_cut_parse(Json *json);

/* The list of a cut. */
const cJSON *json_cut_list(const Json *json, int cut);

/* Where a value begins in the text. */
const char *json_where(const Json *json, const cJSON *item);

/* A value's place, for what is told about it without an error. Looks through the text up to there. */
typedef struct JsonPlace {
    long line, column;
    char path[256]; /* objects[2].faces[0] */
} JsonPlace;

JsonPlace json_place(const Json *json, const cJSON *item);

#endif
