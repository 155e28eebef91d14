/* Long lists that are left out of a tree. The mark of a cut list is a string that begins with a byte which UTF-8 does
 * not have, so that no text that json_scan accepts has such a string; the number of the cut follows. */
#include "json/json.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define MARK '\xFF'

enum { MARK_SIZE = 16 }; /* bytes of a mark at most, quotes included */

/* The text with a mark in place of each cut. NULL without memory. */
static char *shortened(const Json *json, size_t *length)
{
    size_t size = (size_t)json->length + 1;
    for (int i = 0; i < json->cuts.count; i++)
        size += MARK_SIZE - (size_t)(json->cuts.spans[i].end - json->cuts.spans[i].begin);
    char *text = malloc(size), *at = text;
    if (!text)
        return NULL;
    const char *from = json->text;
    for (int i = 0; i < json->cuts.count; i++) {
        JsonSpan cut = json->cuts.spans[i];
        memcpy(at, from, (size_t)(cut.begin - from));
        at += cut.begin - from;
        at += snprintf(at, MARK_SIZE, "\"%c%d\"", MARK, i);
        from = cut.end;
    }
    size_t rest = (size_t)(json->text + json->length - from);
    memcpy(at, from, rest);
    at[rest] = '\0';
    *length = (size_t)(at - text) + rest;
    return text;
}

bool json_cut_parse(Json *json)
{
    size_t length = (size_t)json->length;
    char *text = json->cuts.count > 0 ? shortened(json, &length) : json->text;
    json->root = text ? cJSON_ParseWithLength(text, length + 1) : NULL;
    if (text != json->text)
        free(text);
    return json->root != NULL;
}

static int cut_of(const cJSON *list)
{
    const cJSON *mark = cJSON_IsArray(list) ? list->child : NULL;
    return mark && cJSON_IsString(mark) && mark->valuestring[0] == MARK ? atoi(mark->valuestring + 1) : -1;
}

bool json_is_cut(const Json *json, const cJSON *list, JsonSpan *inside)
{
    int cut = cut_of(list);
    if (cut >= 0)
        *inside = json->cuts.spans[cut];
    return cut >= 0;
}

static const cJSON *search(const cJSON *item, int cut)
{
    const cJSON *found = cut_of(item) == cut ? item : NULL;
    for (const cJSON *child = item->child; child && !found; child = child->next)
        found = search(child, cut);
    return found;
}

const cJSON *json_cut_list(const Json *json, int cut)
{
    return search(json->root, cut);
}

bool json_take_element(Json *element, const Json *whole, const cJSON *list, const char *at, int index)
{
    *element = (Json){.name = whole->name,
                      .text = whole->text,
                      .length = whole->length,
                      .begin = at,
                      .error = whole->error,
                      .whole = whole,
                      .list = list,
                      .index = index};
    element->root = cJSON_ParseWithLength(at, (size_t)(json_bulk_skip(at) - at));
    return element->root || error_memory(whole->error, "an element of a list");
}
