/* Wavefront OBJ models and their MTL libraries, read line by line. */
#ifndef RECTRAY_SCENE_OBJ_H
#define RECTRAY_SCENE_OBJ_H

#include "reader/scene_build.h"

/* Adds the vertices and faces of an OBJ file to the object that was begun last; a face's place is its line. Of the file
 * `v`, `f`, `usemtl` and `mtllib` are read and all other lines skipped. `usemtl` finds a material of the scene, then of
 * the libraries (which is then added to the scene), else the object's own is used. Errors are "PATH:LINE: reason". */
bool scene_obj_read(SceneBuild *build, const char *path);

#endif
