/* The materials of the libraries that one model names, and what is to be told of them. */
#ifndef RECTRAY_MTL_LIBRARY_H
#define RECTRAY_MTL_LIBRARY_H

#include "base/names.h"
#include "reader/note_kinds.h"
#include "scene/scene.h"

/* What a material asks for and does not get. It is told where a face has the material. */
typedef struct MtlRemark {
    NoteName note;
    long line;
    char *detail; /* NULL: none */
} MtlRemark;

typedef struct MtlMaterial {
    Material material;
    int used_as;       /* its index in the scene, -1: not used yet */
    const char *path;  /* of its library */
    long ambient_line; /* of its Ka; 0: it has none */
    int first_remark, remark_count;
    char *fault; /* what cannot be read of it; NULL: nothing. It matters where a face has the material */
    long fault_line;
    long named_at; /* the line of the model that names the library */
} MtlMaterial;

/* The materials of all libraries that one model names. */
typedef struct MtlLibrary {
    MtlMaterial *items;
    int count, capacity;
    Names names;
    MtlRemark *remarks;
    int remark_count, remark_capacity;
    char **files; /* read so far: exporters repeat the line */
    int file_count, file_capacity;
} MtlLibrary;

/* Adds a material of a new name, which is copied. NULL without memory. */
MtlMaterial *mtl_library_add(MtlLibrary *library, const char *name, const char *path, Error *error);

/* Adds a remark on the material that was added last. */
bool mtl_library_remark(MtlLibrary *library, MtlRemark remark, Error *error);

/* Tells what was remarked on a material. */
bool mtl_library_tell(const MtlLibrary *library, const MtlMaterial *material, Notes *notes, Error *error);

void mtl_library_free(MtlLibrary *library);

#endif
