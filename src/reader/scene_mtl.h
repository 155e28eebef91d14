/* Material libraries (MTL) of Wavefront OBJ models. */
#ifndef RECTRAY_SCENE_MTL_H
#define RECTRAY_SCENE_MTL_H

#include "base/names.h"
#include "scene/scene.h"

/* The materials of all libraries that one model names. */
typedef struct MtlLibrary {
    Material *materials;
    int *used_as; /* a material's index in the scene, -1: not used yet */
    int count, capacity, used_capacity;
    Names names;
    char **files; /* read so far: exporters repeat the line */
    int file_count, file_capacity;
} MtlLibrary;

/* Adds a file's materials: newmtl, Ka, Kd, Ks (three numbers of 0 or more), Ns;
 * other lines are skipped, what is not given is 0, as is the reflection. A file
 * that was read is not read again. Errors: "PATH:LINE: reason". Takes the path. */
bool scene_mtl_read(MtlLibrary *library, char *path, Error *error);

void scene_mtl_free(MtlLibrary *library);

#endif
