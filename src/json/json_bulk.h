/* Parts of a JSON text read straight from it, where a scene has millions of numbers: no tree is built of them.
 * A function begins at `at`, where blanks may stand before its piece, and returns the piece's end. NULL says only that
 * the text is not exactly the piece. The caller then reads all of the text through the tree (json.h), which accepts it
 * or tells what is wrong with it: what is accepted here must be accepted there, with the same values. */
#ifndef RECTRAY_JSON_BULK_H
#define RECTRAY_JSON_BULK_H

#include "base/number.h"
#include "json/json_scan.h"

#include <string.h>

/* A piece of a text. */
typedef struct JsonSpan {
    const char *begin, *end;
} JsonSpan;

static inline const char *json_blanks(const char *at)
{
    while (*at == ' ' || *at == '\t' || *at == '\n' || *at == '\r')
        at++;
    return at;
}

/* A bracket, a comma or a colon. */
static inline const char *json_bulk_mark(const char *at, char mark)
{
    at = json_blanks(at);
    return *at == mark ? at + 1 : NULL;
}

static inline const char *json_bulk_number(const char *at, double *value)
{
    at = json_blanks(at);
    const char *end = number_read(at, NUMBER_JSON, value);
    return end && end - at <= JSON_MAX_NUMBER ? end : NULL;
}

/* [x, y, z] */
static inline const char *json_bulk_triple(const char *at, double values[3])
{
    return (at = json_bulk_mark(at, '[')) && (at = json_bulk_number(at, &values[0])) &&
                   (at = json_bulk_mark(at, ',')) && (at = json_bulk_number(at, &values[1])) &&
                   (at = json_bulk_mark(at, ',')) && (at = json_bulk_number(at, &values[2]))
               ? json_bulk_mark(at, ']')
               : NULL;
}

/* A whole number from 0 to 2^31 - 1, written in any way. */
static inline const char *json_bulk_index(const char *at, int *value)
{
    double number;
    int digits = 0, index = 0;
    at = json_blanks(at);
    for (; number_is_digit(at[digits]) && digits < 10; digits++)
        index = digits < 9 ? 10 * index + (at[digits] - '0') : index;
    *value = index;
    bool plain = digits > 0 && digits <= 9 && (at[0] != '0' || digits == 1);
    if (plain && at[digits] != '.' && at[digits] != 'e' && at[digits] != 'E')
        return at + digits;
    at = json_bulk_number(at, &number);
    if (!at || !(number >= 0 && number <= 2147483647.0) || number != (double)(int)number)
        return NULL;
    *value = (int)number;
    return at;
}

/* A string of plain characters: ASCII, no escapes. The span is what stands between the quotes. */
static inline const char *json_bulk_string(const char *at, JsonSpan *span)
{
    at = json_blanks(at);
    if (*at != '"')
        return NULL;
    span->begin = ++at;
    while (*at != '"' && *at != '\\' && (unsigned char)*at >= 0x20 && (unsigned char)*at < 0x80)
        at++;
    span->end = at;
    return *at == '"' ? at + 1 : NULL;
}

static inline bool json_span_is(JsonSpan span, const char *word)
{
    size_t length = (size_t)(span.end - span.begin);
    return strlen(word) == length && memcmp(span.begin, word, length) == 0;
}

/* Any value, of which only brackets, quotes and the end are looked at. */
const char *json_bulk_skip(const char *at);

/* Whether an object's keys are few, plain and all different, and no object is in it. The text is known to be JSON. */
bool json_bulk_keys_differ(const char *at);

/* The inside of the list that the text's outermost object has under a key. */
bool json_bulk_find(const char *text, const char *key, JsonSpan *inside);

#endif
