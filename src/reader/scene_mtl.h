/* Material libraries (MTL) of Wavefront OBJ models. To read a further key, see mtl_line.c. */
#ifndef RECTRAY_SCENE_MTL_H
#define RECTRAY_SCENE_MTL_H

#include "reader/mtl_library.h"

/* Adds a file's materials: newmtl, Ka, Kd, Ks (one number or three, of 0 or more), Ns, illum; what is not given is 0.
 * Of two materials of one name the first counts, which `notes` tells. A file that was read is not read again. Errors:
 * "PATH:LINE: reason". Takes the path. */
bool scene_mtl_read(MtlLibrary *library, char *path, Notes *notes, Error *error);

#endif
