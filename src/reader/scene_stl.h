/* STL models: triangles that share no vertices, as text or binary. The normals in them are not used: the order of the
 * vertices says them, too. */
#ifndef RECTRAY_SCENE_STL_H
#define RECTRAY_SCENE_STL_H

#include "reader/scene_build.h"

/* Whether a file is an STL, by its first bytes. A binary one is as long as the number of its triangles says, since some
 * begin with the word "solid", as those of text do. */
bool scene_stl_is_text(const char *text);
bool scene_stl_is_binary(const char *bytes, long length, long size);

/* Adds the triangles to the object that was begun last. Each solid of a text is a part of the object. A face's place is
 * its line, or in a binary file the negative of its number from 1. */
bool scene_stl_read(SceneBuild *build, const char *path, bool is_binary);

#endif
