/* The scene file: JSON in, Scene out. To add a key: scene_values.h. */
#ifndef RECTRAY_SCENE_JSON_H
#define RECTRAY_SCENE_JSON_H

#include "scene/scene.h"

/* Reads a scene and all models that it names, relative to its own folder. On failure the scene is zeroed, and the error
 * is "PATH:LINE:COLUMN: WHERE: reason" with the line and a caret below, "PATH:LINE: reason" for a fault inside an OBJ
 * or MTL file, or ERROR_SYSTEM for memory and failing disks. Free with scene_free. */
bool scene_load(Scene *scene, const char *path, Error *error);

/* A value to put into the scene file's text before it is read: json_edit.h. */
typedef struct SceneEdit {
    const char *path, *value;
    const char *origin; /* for messages: the option that asks for it, with its value */
} SceneEdit;

typedef struct SceneEdits {
    const SceneEdit *items;
    int count;
} SceneEdits;

/* scene_load of the file with the edits in it, one after the other. The file itself stays as it is. A fault of a path
 * is an ERROR_USAGE that begins with the edit's origin; one of the scene says with which edits it was read. */
bool scene_load_edited(Scene *scene, const char *path, SceneEdits edits, Error *error);

/* The same for a text on the heap that ends in a NUL; it is freed here. */
bool scene_take_edited(Scene *scene, const char *name, char *text, SceneEdits edits, Error *error);

/* The same for `length` bytes of text; `path` stands in messages, and models are looked for beside it. */
bool scene_parse(Scene *scene, const char *path, const char *text, long length, Error *error);

/* Which way a text goes: numbers straight from the text, everything through the tree of values, or the first and, where
 * it does not succeed, the second. The tests hold the two against each other. */
typedef enum SceneWay { SCENE_WAY_ANY, SCENE_WAY_BULK, SCENE_WAY_TREE } SceneWay;

/* scene_parse by one way. In bulk a failure need not fill the error. */
bool scene_parse_by(SceneWay way, Scene *scene, const char *path, const char *text, long length, Error *error);

#endif
