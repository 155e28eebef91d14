/* The "transform" of an object: a list of steps scale, rotate, translate. To add a kind of step, add a key to
 * read_step's table and a function to transform.h. */
#ifndef RECTRAY_SCENE_TRANSFORM_H
#define RECTRAY_SCENE_TRANSFORM_H

#include "scene/transform.h"
#include "json/json.h"

/* The product of all steps, the first one innermost; the identity where `item` is NULL. A factor of 0, an axis of
 * length 0 and a step of no kind or of two kinds are errors. */
bool scene_transform_read(const Json *json, const cJSON *item, Transform *transform);

#endif
