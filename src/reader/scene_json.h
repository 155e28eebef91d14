/* The scene file: JSON in, Scene out. docs/scene-format.md describes it for users, docs/scene.schema.json for programs;
 * a new key goes into both, and into the table of its object here. */
#ifndef RECTRAY_SCENE_JSON_H
#define RECTRAY_SCENE_JSON_H

#include "scene/scene.h"

/* Reads a scene and all models that it names, relative to its own folder. On failure the scene is zeroed, and the error
 * is "PATH:LINE:COLUMN: WHERE: reason" with the line and a caret below, "PATH:LINE: reason" for a fault inside an OBJ
 * or MTL file, or ERROR_SYSTEM for memory and failing disks. Free with scene_free. */
bool scene_load(Scene *scene, const char *path, Error *error);

/* The same for `length` bytes of text; `path` stands in messages, and models are looked for beside it. */
bool scene_parse(Scene *scene, const char *path, const char *text, long length, Error *error);

#endif
