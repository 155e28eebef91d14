/* The model that an object of a scene file names. */
#ifndef RECTRAY_OBJECT_MODEL_H
#define RECTRAY_OBJECT_MODEL_H

#include "reader/scene_build.h"
#include "json/json_read.h"

/* Adds the faces of the model, whose name `item` is, to the object that was begun last. is_named: the object has a name
 * of its own. A file that cannot be read is told at the item; a fault inside it says its own place. */
bool object_model_read(const Json *json, const cJSON *item, bool is_named, SceneBuild *build);

/* Fails where a key of the object seems to be meant for a model and is not "obj". */
bool object_model_check_keys(const Json *json, const cJSON *object);

#endif
