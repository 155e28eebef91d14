/* The materials of a model's faces: usemtl and mtllib. A name is looked for in the scene, then in the libraries, which
 * may be named below the faces. Where it is in neither, the object's own material is used. */
#ifndef RECTRAY_OBJ_MATERIALS_H
#define RECTRAY_OBJ_MATERIALS_H

#include "base/text.h"
#include "reader/mtl_library.h"
#include "reader/scene_build.h"

/* Names that were not known where they were used. */
typedef struct ObjLate {
    char *name;
    long line;
    int material; /* in the end */
} ObjLate;

/* A face's material, while the model is read: one of the scene, -1 for the object's own, or from here on a late one. */
enum { OBJ_LATE = 1 << 30 };

typedef struct ObjMaterials {
    SceneBuild *build;
    const char *path; /* of the model; borrowed */
    MtlLibrary library;
    ObjLate *late;
    int late_count, late_capacity;
    int current;            /* of the faces that follow */
    Quoted missing_library; /* the first; empty: none is */
    long missing_line;
} ObjMaterials;

/* usemtl; an empty name is the object's own material. */
bool obj_materials_use(ObjMaterials *materials, const char *name, long line);

/* mtllib: reads the files of that line. A missing one is a note. */
bool obj_materials_add(ObjMaterials *materials, char *names, long line);

/* Looks for the late names once more. What is still missing is told. */
bool obj_materials_find_late(ObjMaterials *materials);

/* The material that a face has in the end: -1, with an error, where there is none. */
int obj_materials_of_face(const ObjMaterials *materials, int material, long line);

void obj_materials_free(ObjMaterials *materials);

#endif
