/* The file of a model: what format its first bytes say that it has, and the reader of that format. To read a further
 * format: its reader, its line in scene_model.c. */
#ifndef RECTRAY_SCENE_MODEL_H
#define RECTRAY_SCENE_MODEL_H

#include "reader/scene_build.h"

/* Adds the vertices and faces of a Wavefront OBJ, a PLY or an STL file to the object that was begun last. A face's
 * place is its line, or in a binary file the negative of its number from 1. Errors: those of the readers,
 * "PATH:LINE: reason"; a file of another format is told by its name. */
bool scene_model_read(SceneBuild *build, const char *path);

/* Whether the model is a Wavefront OBJ, which alone may name libraries. */
bool scene_model_is_obj(const char *path, Error *error);

#endif
