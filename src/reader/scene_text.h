/* The text of an ordinary scene becomes a Scene. */
#ifndef RECTRAY_SCENE_TEXT_H
#define RECTRAY_SCENE_TEXT_H

#include "scene/scene.h"

/* Which way a text goes: numbers straight from the text, everything through the tree of values, or the first and, where
 * it does not succeed, the second. The tests hold the two against each other. */
typedef enum SceneWay { SCENE_WAY_ANY, SCENE_WAY_BULK, SCENE_WAY_TREE } SceneWay;

/* Reads a text on the heap that ends in a NUL, and takes it over. Where it cannot be read in bulk, it goes
 * through the tree, which knows every place: so there is one list of messages, and the first error of a file is the
 * same whatever its size. The tree has marks instead of long lists (JsonCuts), but for SCENE_WAY_TREE.
 * Errors: scene_load's. In bulk a failure need not fill the error. */
bool scene_text_read(SceneWay way, Scene *scene, const char *path, char *text, long length, Error *error);

/* Gives a scene the camera and the lights of another text with the same objects, which it takes over. After a failure
 * the scene is as it was. */
bool scene_text_move(Scene *scene, const char *path, char *text, Error *error);

#endif
