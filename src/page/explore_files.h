/* Which files a scene is made of: itself, the models that it names, and the material libraries that these name. */
#ifndef RECTRAY_EXPLORE_FILES_H
#define RECTRAY_EXPLORE_FILES_H

#include "base/error.h"

/* A file, and the name under which the scene's reader asks for it. They differ where a library was written on Windows
 * (reader/model_library.h). */
typedef struct ExploreFile {
    char *name, *path;
} ExploreFile;

typedef struct ExploreFiles {
    ExploreFile *items; /* the scene first, each once */
    int count, capacity;
} ExploreFiles;

/* Finds the files of a scene that is known to be valid. Free the list also after a failure. */
bool explore_find_files(ExploreFiles *files, const char *scene_path, Error *error);

void explore_free_files(ExploreFiles *files);

#endif
