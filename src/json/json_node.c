/* Filling a JSON object member by member. */
#include "json/json_node.h"

#include "base/text.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

JsonNode json_node_new(bool *failed)
{
    JsonNode node = {cJSON_CreateObject(), failed};
    *failed = *failed || !node.object;
    return node;
}

static cJSON *put(JsonNode node, const char *name, cJSON *item)
{
    if (item && cJSON_AddItemToObject(node.object, name, item))
        return item;
    cJSON_Delete(item);
    *node.failed = true;
    return NULL;
}

static cJSON *append(JsonNode array, cJSON *item)
{
    if (item && cJSON_AddItemToArray(array.object, item))
        return item;
    cJSON_Delete(item);
    *array.failed = true;
    return NULL;
}

static cJSON *number_of(double x)
{
    char digits[32];
    snprintf(digits, sizeof digits, "%.17g", x == 0 ? 0.0 : x); /* never "-0" */
    return isfinite(x) ? cJSON_CreateRaw(digits) : cJSON_CreateNull();
}

void json_node_number(JsonNode node, const char *name, double x)
{
    put(node, name, number_of(x));
}

void json_node_vector(JsonNode node, const char *name, Vec3 v)
{
    JsonNode array = json_node_array(node, name);
    json_node_append_number(array, v.x);
    json_node_append_number(array, v.y);
    json_node_append_number(array, v.z);
}

/* In UTF-8; NULL without memory. */
static cJSON *string_of(const char *text)
{
    char *copy = strdup(text);
    if (copy)
        text_make_utf8(copy);
    cJSON *item = copy ? cJSON_CreateString(copy) : NULL;
    free(copy);
    return item;
}

void json_node_text(JsonNode node, const char *name, const char *text)
{
    put(node, name, string_of(text));
}

void json_node_append_text(JsonNode array, const char *text)
{
    append(array, string_of(text));
}

void json_node_bool(JsonNode node, const char *name, bool value)
{
    put(node, name, cJSON_CreateBool(value));
}

JsonNode json_node_object(JsonNode node, const char *name)
{
    return (JsonNode){put(node, name, cJSON_CreateObject()), node.failed};
}

JsonNode json_node_array(JsonNode node, const char *name)
{
    return (JsonNode){put(node, name, cJSON_CreateArray()), node.failed};
}

void json_node_append_number(JsonNode array, double x)
{
    append(array, number_of(x));
}

void json_node_append_vector(JsonNode array, Vec3 v)
{
    JsonNode element = {append(array, cJSON_CreateArray()), array.failed};
    json_node_append_number(element, v.x);
    json_node_append_number(element, v.y);
    json_node_append_number(element, v.z);
}

JsonNode json_node_append_object(JsonNode array)
{
    return (JsonNode){append(array, cJSON_CreateObject()), array.failed};
}
