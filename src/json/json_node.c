/* Filling a JSON object member by member. */
#include "json/json_node.h"

#include "base/text.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

Node node_new(bool *failed)
{
    Node node = {cJSON_CreateObject(), failed};
    *failed = *failed || !node.object;
    return node;
}

static cJSON *put(Node node, const char *name, cJSON *item)
{
    if (item && cJSON_AddItemToObject(node.object, name, item))
        return item;
    cJSON_Delete(item);
    *node.failed = true;
    return NULL;
}

static cJSON *append(Node array, cJSON *item)
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

void node_number(Node node, const char *name, double x)
{
    put(node, name, number_of(x));
}

void node_vector(Node node, const char *name, Vec3 v)
{
    Node array = node_array(node, name);
    node_append_number(array, v.x);
    node_append_number(array, v.y);
    node_append_number(array, v.z);
}

void node_text(Node node, const char *name, const char *text)
{
    char *copy = strdup(text);
    if (copy)
        text_make_utf8(copy);
    put(node, name, copy ? cJSON_CreateString(copy) : NULL);
    free(copy);
}

void node_bool(Node node, const char *name, bool value)
{
    put(node, name, cJSON_CreateBool(value));
}

Node node_object(Node node, const char *name)
{
    return (Node){put(node, name, cJSON_CreateObject()), node.failed};
}

Node node_array(Node node, const char *name)
{
    return (Node){put(node, name, cJSON_CreateArray()), node.failed};
}

void node_append_number(Node array, double x)
{
    append(array, number_of(x));
}

void node_append_vector(Node array, Vec3 v)
{
    Node element = {append(array, cJSON_CreateArray()), array.failed};
    node_append_number(element, v.x);
    node_append_number(element, v.y);
    node_append_number(element, v.z);
}

Node node_append_object(Node array)
{
    return (Node){append(array, cJSON_CreateObject()), array.failed};
}
