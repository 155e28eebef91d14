/* What a scene file says, out of its tree of values. docs/scene-format.md describes it for users,
 * docs/scene.schema.json for programs; a new key goes into both, and into the table of its object in scene_values.c. */
#ifndef RECTRAY_SCENE_VALUES_H
#define RECTRAY_SCENE_VALUES_H

#include "reader/scene_bulk.h"

/* Reads a parsed file, and frees it. objects: the inside of their list, which the tree lacks and which is then read in
 * bulk, with or without an error where that fails; NULL: the tree has the objects, and an error gets its place. */
bool scene_values_read(Scene *scene, Json *json, const JsonSpan *objects);

/* Gives a scene the camera and the lights of a parsed file with the same objects, which the tree may lack, and frees
 * the tree. After a failure the scene is as it was. */
bool scene_values_move(Scene *scene, Json *json);

#endif
