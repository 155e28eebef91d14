/* The vertices and faces of an object of a scene file, out of its tree, or where that lacks them out of the text. */
#ifndef RECTRAY_SCENE_MESH_H
#define RECTRAY_SCENE_MESH_H

#include "reader/scene_build.h"
#include "json/json.h"

/* The number of the scene's material that a value names. */
bool scene_mesh_material(const Json *json, const cJSON *item, const SceneBuild *build, int *material);

/* Adds the vertices and the faces to the object that was begun. */
bool scene_mesh_read(const Json *json, const cJSON *vertices, const cJSON *faces, SceneBuild *build);

/* Reports the face of the list that scene_build_finish failed at. */
bool scene_mesh_fail_face(const Json *json, const cJSON *faces, const SceneBuild *build);

#endif
