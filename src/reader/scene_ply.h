/* PLY models, as text and binary: the vertices and the faces; what else they hold is told. */
#ifndef RECTRAY_SCENE_PLY_H
#define RECTRAY_SCENE_PLY_H

#include "reader/scene_build.h"

/* Adds the vertices and faces to the object that was begun last. A face's place is its line, or in a binary file the
 * negative of its number from 1. Errors: "PATH:LINE: reason", "PATH: ELEMENT NUMBER: reason". */
bool scene_ply_read(SceneBuild *build, const char *path);

#endif
