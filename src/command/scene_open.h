/* Reads the scene that a command works on, and tells what reading it had to say. */
#ifndef RECTRAY_SCENE_OPEN_H
#define RECTRAY_SCENE_OPEN_H

#include "command/options.h"
#include "scene/scene.h"

/* scene_load for the first operand. Its notes go to standard error, unless --quiet; --strict makes an error of them. */
bool scene_open(Scene *scene, const Options *options, Error *error);

/* The first part of it: the scene with the changes that options ask for; its notes are not told. */
bool scene_open_load(Scene *scene, const Options *options, Error *error);

/* What scene_open does with a scene's notes; with `every`, tells each place of each. */
bool scene_open_tell(const Notes *notes, const Options *options, bool every, Error *error);

#endif
