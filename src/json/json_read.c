/* Typed values out of a JSON tree. */
#include "json/json_read.h"

#include "base/suggest.h"
#include "base/text.h"

#include <assert.h>
#include <math.h>
#include <string.h>

static const char *type_of(const cJSON *item)
{
    return cJSON_IsObject(item)   ? "an object"
           : cJSON_IsArray(item)  ? "a list"
           : cJSON_IsString(item) ? "a string"
           : cJSON_IsNumber(item) ? "a number"
           : cJSON_IsBool(item)   ? "true or false"
                                  : "null";
}

bool json_fail_type(const Json *json, const cJSON *item, const char *wanted)
{
    return json_fail(json, item, "must be %s, not %s", wanted, type_of(item));
}

bool json_is_comment(const cJSON *member)
{
    return strcmp(member->string, "//") == 0;
}

bool json_check_comment(const Json *json, const cJSON *member)
{
    for (const cJSON *line = cJSON_IsArray(member) ? member->child : NULL; line; line = line->next)
        if (!cJSON_IsString(line))
            return json_fail_type(json, line, "a string, as a line of a comment");
    return cJSON_IsString(member) || cJSON_IsArray(member) ||
           json_fail_type(json, member, "a string or a list of strings");
}

/* Suggests the nearest known key, and lists all that are known here. */
static bool fail_unknown(const Json *json, const cJSON *member, const JsonMember *members, int count)
{
    enum { MOST = 16 };
    const char *names[MOST + 1] = {NULL};
    char known[256] = "";
    assert(count <= MOST);
    for (int i = 0; i < count; i++) {
        size_t length = strlen(known);
        snprintf(known + length, sizeof known - length, "%s%s", i ? ", " : "", members[i].name);
        names[i] = members[i].name;
    }
    const char *nearest = suggest_word(member->string, names);
    if (!nearest)
        return json_fail_key(json, member, "unknown key; known here: %s", known);
    return json_fail_key(json, member, "unknown key; did you mean \"%s\"? (known here: %s)", nearest, known);
}

bool json_members(const Json *json, const cJSON *object, JsonMember *members, int count)
{
    if (!cJSON_IsObject(object))
        return json_fail_type(json, object, "an object");
    for (const cJSON *member = object->child; member; member = member->next) {
        if (json_is_comment(member)) {
            if (!json_check_comment(json, member))
                return false;
            continue;
        }
        int i = 0;
        while (i < count && strcmp(member->string, members[i].name) != 0)
            i++;
        if (i == count)
            return fail_unknown(json, member, members, count);
        members[i].item = member;
    }
    for (int i = 0; i < count; i++)
        if (members[i].required && !members[i].item)
            return json_fail(json, object, "the key \"%s\" is missing", members[i].name);
    return true;
}

bool json_number(const Json *json, const cJSON *item, double low, double high, double *value)
{
    if (!cJSON_IsNumber(item))
        return json_fail_type(json, item, "a number");
    *value = item->valuedouble;
    return (*value >= low && *value <= high) ||
           json_fail(json, item, "must be from %g to %g, not %.15g", low, high, *value);
}

bool json_integer(const Json *json, const cJSON *item, int low, int high, int *value)
{
    if (!cJSON_IsNumber(item))
        return json_fail_type(json, item, "a whole number");
    double number = item->valuedouble;
    if (number != floor(number))
        return json_fail(json, item, "must be a whole number, not %.15g", number);
    if (!(number >= low && number <= high))
        return json_fail(json, item, "must be from %d to %d, not %.15g", low, high, number);
    *value = (int)number;
    return true;
}

bool json_vec3(const Json *json, const cJSON *item, double low, double high, Vec3 *value)
{
    if (!cJSON_IsArray(item))
        return json_fail_type(json, item, "a list of three numbers");
    int count = cJSON_GetArraySize(item);
    if (count != 3)
        return json_fail(json, item, "must be a list of three numbers, not of %d", count);
    const cJSON *x = item->child;
    return json_number(json, x, low, high, &value->x) && json_number(json, x->next, low, high, &value->y) &&
           json_number(json, x->next->next, low, high, &value->z);
}

bool json_string(const Json *json, const cJSON *item, const char **value)
{
    if (!cJSON_IsString(item))
        return json_fail_type(json, item, "a string");
    *value = item->valuestring;
    return true;
}

bool json_choice(const Json *json, const cJSON *item, const char *const *words, int count, int *index)
{
    const char *word = NULL;
    if (!json_string(json, item, &word))
        return false;
    for (*index = 0; *index < count; ++*index)
        if (strcmp(word, words[*index]) == 0)
            return true;
    char known[128] = "";
    for (int i = 0; i < count; i++) {
        size_t length = strlen(known);
        snprintf(known + length, sizeof known - length, "%s\"%s\"", i ? " or " : "", words[i]);
    }
    return json_fail(json, item, "must be %s, not %s", known, text_quote(word).text);
}

bool json_list(const Json *json, const cJSON *item)
{
    return cJSON_IsArray(item) || json_fail_type(json, item, "a list");
}
