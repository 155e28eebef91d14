/* JSON with places: loading. */
#include "json/json.h"

#include "base/text.h"
#include "json/json_scan.h"

#include <stdlib.h>
#include <string.h>

typedef struct Key {
    const cJSON *item;
    int index; /* among its object's members */
} Key;

static int compare_keys(const void *a, const void *b)
{
    const Key *x = a, *y = b;
    int order = strcmp(x->item->string, y->item->string);
    return order ? order : x->index - y->index;
}

/* A key that stands twice, and its object. */
typedef struct Repeated {
    const cJSON *object, *key;
} Repeated;

/* Sorts the keys of each object, so that a hostile file with a million of them takes no million squared comparisons.
 * Stops at the first object, in the order of the text, that has a key twice. False without memory. */
static bool find_repeated(const Json *json, const cJSON *item, Repeated *repeated)
{
    int count = cJSON_IsObject(item) ? cJSON_GetArraySize(item) : 0;
    if (count > 1) {
        Key *keys = malloc((size_t)count * sizeof *keys);
        if (!keys)
            return error_memory(json->error, "keys");
        int i = 0;
        for (const cJSON *child = item->child; child; child = child->next, i++)
            keys[i] = (Key){child, i};
        qsort(keys, (size_t)count, sizeof *keys, compare_keys);
        Key first = {NULL, count};
        for (i = 1; i < count; i++)
            if (strcmp(keys[i].item->string, keys[i - 1].item->string) == 0 && keys[i].index < first.index)
                first = keys[i];
        free(keys);
        *repeated = (Repeated){item, first.item};
    }
    for (const cJSON *child = item->child; child && !repeated->key; child = child->next)
        if (child->child && !find_repeated(json, child, repeated))
            return false;
    return true;
}

static bool fail_repeated(const Json *json, const Repeated *repeated)
{
    return json_fail_key(json, repeated->key, "the key stands twice in this object; keep one of the two");
}

/* Has the element no key twice? Most need no tree for that. */
static bool check_element(const Json *json, int cut, const char *at, const char *end, int index)
{
    Json element;
    Repeated repeated = {NULL, NULL};
    if (!memchr(at, '{', (size_t)(end - at)) || json_bulk_keys_differ(at))
        return true;
    bool good = json_take_element(&element, json, NULL, at, index) && find_repeated(&element, element.root, &repeated);
    if (repeated.key) {
        element.list = json_cut_list(json, cut);
        good = fail_repeated(&element, &repeated);
    }
    json_free(&element);
    return good;
}

static bool check_cut(const Json *json, int cut)
{
    JsonSpan inside = json->cuts.spans[cut];
    if (!memchr(inside.begin, '{', (size_t)(inside.end - inside.begin)))
        return true;
    int index = 0;
    for (const char *at = json_blanks(inside.begin); at < inside.end; index++) {
        const char *end = json_bulk_skip(at);
        if (!check_element(json, cut, at, end, index))
            return false;
        at = json_blanks(json_blanks(end) + 1); /* the comma, or the bracket after the last */
    }
    return true;
}

/* Whether no key stands twice, in the order of the text: what was cut out before the tree's first such object, too. */
static bool check_keys(const Json *json)
{
    Repeated repeated = {NULL, NULL};
    if (!find_repeated(json, json->root, &repeated))
        return false;
    const char *before = repeated.key ? json_where(json, repeated.object) : json->text + json->length;
    for (int i = 0; i < json->cuts.count && json->cuts.spans[i].begin < before; i++)
        if (!check_cut(json, i))
            return false;
    return !repeated.key || fail_repeated(json, &repeated);
}

/* Takes over json->text. */
static bool parse(Json *json)
{
    json->begin = json->text;
    JsonFault fault = json_scan(json->text, json->length);
    bool good = false;
    if (fault.place)
        json_fail_at(json, fault.place, "", fault.reason);
    else if (!json_cut_parse(json))
        error_memory(json->error, "the tree of a JSON file"); /* the scan left no other reason */
    else
        good = check_keys(json);
    if (!good)
        json_free(json);
    return good;
}

bool json_load(Json *json, const char *path, Error *error)
{
    *json = (Json){.name = text_input_name(path), .error = error};
    json->text = text_read_input(path, JSON_MAX_BYTES, &json->length, error);
    return json->text && parse(json);
}

bool json_take(Json *json, const char *name, char *text, long length, Error *error)
{
    return json_take_cut(json, name, text, length, (JsonCuts){NULL, 0}, error);
}

bool json_take_cut(Json *json, const char *name, char *text, long length, JsonCuts cuts, Error *error)
{
    *json = (Json){.name = name, .text = text, .length = length, .cuts = cuts, .error = error};
    return parse(json);
}

bool json_parse(Json *json, const char *name, const char *text, long length, Error *error)
{
    *json = (Json){0};
    char *copy = malloc((size_t)length + 1);
    if (!copy)
        return error_memory(error, name);
    memcpy(copy, text, (size_t)length);
    copy[length] = '\0';
    return json_take(json, name, copy, length, error);
}

void json_free(Json *json)
{
    cJSON_Delete(json->root);
    if (!json->whole)
        free(json->text);
    free(json->cuts.spans);
    *json = (Json){0};
}
