/* Which files a scene is made of: itself, the models that it names, and the material libraries that these name. */
#ifndef RECTRAY_EXPLORE_FILES_H
#define RECTRAY_EXPLORE_FILES_H

#include "base/error.h"

typedef struct ExploreFiles {
    char **paths; /* the scene first, each once */
    int count, capacity;
} ExploreFiles;

/* Finds the files of a scene that is known to be valid. Free the list also after a failure. */
bool explore_find_files(ExploreFiles *files, const char *scene_path, Error *error);

void explore_free_files(ExploreFiles *files);

#endif
