/* The "objects" of a scene file read straight from its text: vertices, faces and boxes become numbers without a tree of
 * values in between, which would take twenty times their time and memory. What else an object has goes through
 * scene_objects.h, as a small text of its own. */
#ifndef RECTRAY_SCENE_BULK_H
#define RECTRAY_SCENE_BULK_H

#include "reader/scene_build.h"
#include "json/json.h"
#include "json/json_bulk.h"

/* Adds each object of the list whose inside is given. The shapes of its faces are checked by scene_build_finish. False,
 * with or without an error, where anything is not as it should be: scene_objects_read then finds out what. */
bool scene_bulk_read(const Json *json, JsonSpan objects, SceneBuild *build);

#endif
