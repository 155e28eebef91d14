/* The vertices, faces and boxes of a scene file's objects, read straight from its text. The functions go on from `at`
 * to the end that they return; NULL: not exactly that (json_bulk.h). */
#ifndef RECTRAY_BULK_SHAPE_H
#define RECTRAY_BULK_SHAPE_H

#include "reader/scene_build.h"
#include "json/json_bulk.h"

/* What an object is made of, while it is read. Its points and faces stand in the arrays of the build, behind those that
 * are there to stay. */
typedef struct BulkShape {
    SceneBuild *build;
    int point_count, face_count;
    bool has_polygons; /* faces of more than four vertices, of which the arrays of the build have no more */
    bool has_box;
    Vec3 low, high;
    JsonSpan last_material; /* and its number: most faces have their neighbour's */
    int last_index;
} BulkShape;

/* [[x, y, z], ...] */
const char *bulk_vertices(BulkShape *shape, const char *at);

/* A face: the first vertices, as many as there is room for, and how many it has; its material, or -1. */
typedef struct BulkRow {
    int *vertices;
    int room, count, material;
} BulkRow;

/* Lists of 3 indices or more, or objects with one under "vertices" and a "material"; any material of a face is then the
 * scene's, -1 where it has none. */
const char *bulk_faces(BulkShape *shape, const char *at);
const char *bulk_face(BulkShape *shape, const char *at, BulkRow *row);

/* Adds the vertex or the face that begins at `at` to the build's object, a face with the number that its reader has for
 * it. NULL: it is not added; without memory the build's error is filled. */
const char *bulk_add_vertex(BulkShape *shape, const char *at);
const char *bulk_add_face(BulkShape *shape, const char *at, int place);

/* {"min": [x, y, z], "max": [x, y, z]}, each below the other */
const char *bulk_box(BulkShape *shape, const char *at);

/* The number of the scene's material of that name; -1: there is none. */
int bulk_material(BulkShape *shape, JsonSpan name);

/* Past the comma or the bracket that follows an element: *more says that another one follows. */
const char *bulk_after(const char *at, bool *more);

#endif
