/* The faces of a model, whose references may name vertices above or below them. As long as all vertices are above their
 * faces, a face is built where it is read. From the first one on that names a vertex below, faces wait for the end. */
#ifndef RECTRAY_OBJ_FACES_H
#define RECTRAY_OBJ_FACES_H

#include "reader/line_scan.h"
#include "reader/obj_materials.h"

/* A face that waits. */
typedef struct ObjWaiting {
    int first, count; /* of its vertices in the list */
    int material;
    long line;
    int part; /* its name's index in the list of those that wait, too; -1: none of them */
} ObjWaiting;

typedef struct ObjFaces {
    SceneBuild *build;
    ObjMaterials *materials;
    int *vertices; /* of the face that is read, and before them those of the faces that wait; from 0 */
    int vertex_count, vertex_capacity;
    ObjWaiting *waiting;
    int waiting_count, waiting_capacity;
    char **parts; /* the names that began while faces waited */
    int part_count, part_capacity;
    int count; /* of all faces so far */
} ObjFaces;

/* Reads the references of an f line, to which the scan points, and goes to the next line. */
bool obj_faces_read(ObjFaces *faces, LineScan *scan);

/* The faces that follow are those of a part of the model. */
bool obj_faces_part(ObjFaces *faces, const char *name);

/* Builds the faces that wait, and gives each face the material that it has in the end. */
bool obj_faces_finish(ObjFaces *faces, const LineScan *scan);

void obj_faces_free(ObjFaces *faces);

#endif
