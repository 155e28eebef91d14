/* Typed values out of a JSON tree: each function takes what it wants or fails with the place and the reason.
 * Nothing is converted, nothing defaulted. To read a new object, list its keys in a table of JsonMember. */
#ifndef RECTRAY_JSON_READ_H
#define RECTRAY_JSON_READ_H

#include "base/vec3.h"
#include "json/json.h"

#include <stdbool.h>

/* One known key of an object. */
typedef struct JsonMember {
    const char *name;
    bool required;
    const cJSON *item; /* filled by json_members; NULL: the key is absent */
} JsonMember;

#define JSON_COUNT(array) ((int)(sizeof(array) / sizeof *(array)))

/* Finds an object's values by its table of `count` keys. Errors: not an object; an unknown key (the nearest known one
 * is named); a required key that is absent; a comment (key "//") that is neither a string nor a list of strings. */
bool json_members(const Json *json, const cJSON *object, JsonMember *members, int count);

/* The key "//", in any object. */
bool json_is_comment(const cJSON *member);

/* Is it a string or a list of strings? */
bool json_check_comment(const Json *json, const cJSON *member);

/* Each of these fails when the value has another type or leaves low <= value <= high. */
bool json_number(const Json *json, const cJSON *item, double low, double high, double *value);
bool json_integer(const Json *json, const cJSON *item, int low, int high, int *value);
bool json_vec3(const Json *json, const cJSON *item, double low, double high, Vec3 *value);

/* The string stays the tree's. */
bool json_string(const Json *json, const cJSON *item, const char **value);

/* The index among `count` words of a string that must be one of them. */
bool json_choice(const Json *json, const cJSON *item, const char *const *words, int count, int *index);

/* Fails unless the value is a list. */
bool json_list(const Json *json, const cJSON *item);

/* "must be WANTED, not a string". */
bool json_fail_type(const Json *json, const cJSON *item, const char *wanted);

#endif
