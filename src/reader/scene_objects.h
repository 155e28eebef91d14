/* The "objects" of a scene file: vertices and faces, boxes and models, with their transforms. */
#ifndef RECTRAY_SCENE_OBJECTS_H
#define RECTRAY_SCENE_OBJECTS_H

#include "reader/scene_build.h"
#include "json/json.h"

/* Adds each object of the list, in order. */
bool scene_objects_read(const Json *json, const cJSON *objects, SceneBuild *build);

/* Begins an object whose vertices, faces or box stand elsewhere; the root of `json` has all its other keys. A model is
 * added, too. False, where it is told otherwise by the keys. */
bool scene_objects_begin(const Json *json, int index, bool is_model, SceneBuild *build);

/* What an object without a name is called. */
typedef struct SceneObjectName {
    char text[32];
} SceneObjectName;

SceneObjectName scene_objects_unnamed(int index);

/* Reports the face that scene_build_finish failed at, with its place in the scene file or in the model. */
bool scene_objects_fail_face(const Json *json, const cJSON *objects, const SceneBuild *build);

#endif
