/* The "objects" of a scene file: vertices and faces, boxes and models, with their transforms. */
#ifndef RECTRAY_SCENE_OBJECTS_H
#define RECTRAY_SCENE_OBJECTS_H

#include "reader/scene_build.h"
#include "json/json.h"

/* Adds each object of the list, in order. */
bool scene_objects_read(const Json *json, const cJSON *objects, SceneBuild *build);

/* Reports the face that scene_build_finish failed at, with its place in the scene file or in the model. */
bool scene_objects_fail_face(const Json *json, const cJSON *objects, const SceneBuild *build);

#endif
