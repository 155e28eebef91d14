/* What a scene file says, out of its tree of values. docs/scene-format.md describes it for users,
 * docs/scene.schema.json for programs; a new key goes into both, and into the table of its object in scene_values.c. */
#ifndef RECTRAY_SCENE_VALUES_H
#define RECTRAY_SCENE_VALUES_H

#include "reader/scene_bulk.h"

/* A try to read the objects in bulk: the inside of their list, which the tree then lacks. */
typedef struct SceneBulk {
    JsonSpan objects;
    bool one_by_one; /* its faces go through scene_build_face */
    bool has_fault;  /* set where a face was not accepted in the end */
} SceneBulk;

/* Reads a parsed file, and frees it. bulk NULL: the tree has the objects, and an error gets its place. */
bool scene_values_read(Scene *scene, Json *json, SceneBulk *bulk);

/* Gives a scene the camera and the lights of a parsed file with the same objects, which the tree may lack, and frees
 * the tree. After a failure the scene is as it was. */
bool scene_values_move(Scene *scene, Json *json);

#endif
