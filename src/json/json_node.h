/* Filling a JSON object member by member, with numbers that keep all their digits. cJSON itself stops at 15 digits where
 * they are nearly enough; these have 17, so that reading them gives the same doubles. */
#ifndef RECTRAY_JSON_NODE_H
#define RECTRAY_JSON_NODE_H

#include "base/vec3.h"

#include <cjson/cJSON.h>
#include <stdbool.h>

/* An object being filled. A failure, which is want of memory, sets *failed and leaves the member out. */
typedef struct Node {
    cJSON *object;
    bool *failed;
} Node;

Node node_new(bool *failed);

/* JSON has no infinity: null. */
void node_number(Node node, const char *name, double x);
void node_vector(Node node, const char *name, Vec3 v); /* [x, y, z] */
void node_text(Node node, const char *name, const char *text); /* what is not UTF-8 becomes '?' */
void node_bool(Node node, const char *name, bool value);

/* An empty object, or an empty array, as a member. */
Node node_object(Node node, const char *name);
Node node_array(Node node, const char *name);

/* The next element of an array. */
void node_append_number(Node array, double x);
void node_append_vector(Node array, Vec3 v);
Node node_append_object(Node array);

#endif
