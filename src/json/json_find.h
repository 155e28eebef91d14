/* A value's place in a text, from its number in the tree. */
#ifndef RECTRAY_JSON_FIND_H
#define RECTRAY_JSON_FIND_H

#include "json/json.h"

/* A value, and its key's opening quote (NULL in a list). */
typedef struct JsonToken {
    const char *value, *key;
} JsonToken;

/* The value that begins after `values_before` others, in a text that json_scan accepts. A cut counts as one value. */
JsonToken json_find_value(const char *text, JsonCuts cuts, long values_before);

#endif
