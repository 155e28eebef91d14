/* The scene file: JSON in, Scene out. To add a key: scene_values.h. */
#ifndef RECTRAY_SCENE_JSON_H
#define RECTRAY_SCENE_JSON_H

#include "reader/scene_edit.h"
#include "reader/scene_text.h"

/* Reads a scene and all models that it names, relative to its own folder. On failure the scene is zeroed, and the error
 * is "PATH:LINE:COLUMN: WHERE: reason" with the line and a caret below, "PATH:LINE: reason" for a fault inside an OBJ
 * or MTL file, or ERROR_SYSTEM for memory and failing disks. Free with scene_free. */
bool scene_load(Scene *scene, const char *path, Error *error);

/* scene_load of the file with the edits in it, one after the other. The file itself stays as it is. Edits of its
 * animation come before the choice of the frame; others change the frame. A fault of a path is an ERROR_USAGE that
 * begins with the edit's origin, as is a frame that does not exist; a fault of the scene says with which edits, and as
 * which frame, it was read. */
bool scene_load_edited(Scene *scene, const char *path, SceneEdits edits, Error *error);

/* The same for a text on the heap that ends in a NUL; it is freed here. */
bool scene_take_edited(Scene *scene, const char *name, char *text, SceneEdits edits, Error *error);

/* The text of the scene file as an ordinary scene: with the edits, as the frame, without the animation. It is read once
 * to see whether it is right; errors as of scene_load_edited, then NULL. Models are named as in the file. */
char *scene_frame_text(const char *path, SceneEdits edits, Error *error);

/* scene_load for `length` bytes of text; `path` stands in messages, and models are looked for beside it. */
bool scene_parse(Scene *scene, const char *path, const char *text, long length, Error *error);

/* scene_parse by one way. In bulk a failure need not fill the error. */
bool scene_parse_by(SceneWay way, Scene *scene, const char *path, const char *text, long length, Error *error);

#endif
