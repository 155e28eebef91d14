/* Filling a JSON object member by member, with numbers that keep all their digits. cJSON itself stops at 15 digits
 * where they are nearly enough; these have 17, so that reading them gives the same doubles. */
#ifndef RECTRAY_JSON_NODE_H
#define RECTRAY_JSON_NODE_H

#include "base/vec3.h"

#include <cjson/cJSON.h>
#include <stdbool.h>

/* An object being filled. A failure, which is want of memory, sets *failed and leaves the member out. */
typedef struct JsonNode {
    cJSON *object;
    bool *failed;
} JsonNode;

JsonNode json_node_new(bool *failed);

/* JSON has no infinity: null. */
void json_node_number(JsonNode node, const char *name, double x);
void json_node_vector(JsonNode node, const char *name, Vec3 v);         /* [x, y, z] */
void json_node_text(JsonNode node, const char *name, const char *text); /* what is not UTF-8 becomes '?' */
void json_node_bool(JsonNode node, const char *name, bool value);

/* An empty object, or an empty array, as a member. */
JsonNode json_node_object(JsonNode node, const char *name);
JsonNode json_node_array(JsonNode node, const char *name);

/* The next element of an array. */
void json_node_append_number(JsonNode array, double x);
void json_node_append_text(JsonNode array, const char *text);
void json_node_append_vector(JsonNode array, Vec3 v);
JsonNode json_node_append_object(JsonNode array);

#endif
