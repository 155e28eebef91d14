/* Builds a Scene from what the readers find: objects, points and faces in world space, in double.
 * The readers know files and places, the builder knows geometry: it gives a reason, they say where. At the end the
 * scene is moved to its own centre and rounded once to float32. To add a kind of object, write a reader
 * that calls scene_build_object, scene_build_point and scene_build_face. */
#ifndef RECTRAY_SCENE_BUILD_H
#define RECTRAY_SCENE_BUILD_H

#include "base/names.h"
#include "reader/note_kinds.h"
#include "scene/polygon_cut.h"
#include "scene/scene.h"
#include "scene/shape.h"
#include "scene/transform.h"

/* No coordinate may be farther than this from the scene's centre: products of three such stay far inside a double. */
#define BUILD_MAX_COORDINATE 1e12

/* What holds for all faces of one object. */
typedef struct SceneBuildObject {
    Transform transform;
    int material; /* -1: none */
    bool one_sided;
    bool split;      /* faces that are not planar are cut, */
    bool tell_split; /* with a note */
    bool skip;       /* faces without area are left out, and points that repeat the one before */
    bool mirrored;   /* set by scene_build_object: the transform turns a right hand into a left one */
    int first_point;
    int first_number; /* how the file counts its vertices: from 0, an OBJ from 1 */
} SceneBuildObject;

/* A face before it is rounded: four numbers of points instead of four points. */
typedef struct SceneBuildFace {
    int points[4];
    int number; /* of the face in the file; the pieces of one that was cut have the same */
    int object, material;
    int place; /* the reader's: an index in a list, or a line of a file */
    unsigned char vertex_count, one_sided;
    unsigned char skip;  /* it may be left out where rounding takes its area */
    unsigned char shape; /* whether scene_build_finish has to look at it */
} SceneBuildFace;

enum {
    BUILD_SHAPE_CHECKED,
    BUILD_SHAPE_UNCHECKED,
    BUILD_SHAPE_UNCHECKED_TURNED /* a mirror turned the face over: the file's order is 0 3 2 1 */
};

/* An object whose faces' places are lines of a file. */
typedef struct SceneBuildModel {
    char *path;
    int object;
} SceneBuildModel;

typedef struct SceneBuild {
    Scene *scene;
    Error *error;
    Names materials; /* the scene file's, by name */
    Vec3 *points;
    int point_count, point_capacity;
    SceneBuildFace *faces;
    int face_count, face_capacity;
    int object_capacity, material_capacity, part_capacity;
    int first_part; /* of the object */
    SceneBuildModel *models;
    int model_count, model_capacity;
    PolygonCut cut; /* of the face being built, where it is not simply added; its corners in the object and the world */
    int *corners;
    Vec3 *corner_points;
    int corner_capacity;
    const char *path;            /* of the scene file */
    int next_number;             /* of a face */
    SceneBuildObject object;     /* the one being built */
    char reason[256];            /* why the last call failed, where the error says nothing */
    const SceneBuildFace *fault; /* the face that scene_build_finish failed at; NULL: the camera, or */
    int fault_light;             /* this light, -1: none */
} SceneBuild;

/* Functions that can fail return false (or -1) and leave a reason; without memory they fill the error instead. */

/* Copies the name. Returns the material's index, or -1 without memory. */
int scene_build_material(SceneBuild *build, Material material);

/* Begins an object; the points and faces that follow are its. The name is copied. */
bool scene_build_object(SceneBuild *build, const char *name, SceneBuildObject object);

/* The faces that follow belong to this part of the object, whose name is copied. */
bool scene_build_part(SceneBuild *build, const char *name);

/* Ends the object's parts. All faces in one part are in none: its name would tell nothing. */
void scene_build_end_parts(SceneBuild *build);

/* Adds a vertex, which the object's transform moves into the world. Fails when that makes it infinite. A vertex that is
 * not finite itself is no fault until a face uses it. */
bool scene_build_point(SceneBuild *build, Vec3 point);

int scene_build_point_count(const SceneBuild *build); /* of the object */

/* Begins a model: the faces of the object that was begun last are at lines of this file, whose path is copied, and its
 * vertices count from 1. */
bool scene_build_model(SceneBuild *build, const char *path);

/* Adds a face over some of the object's points (all must exist), after checking its shape. One that is no good quad or
 * triangle is cut into such, or left out with a note (scene_polygon.h). Of fewer than 3 points it has no area.
 * material -1: the object's. */
bool scene_build_face(SceneBuild *build, const int *vertices, int count, int material, int place);

/* Adds the six faces of an axis-parallel box (before the transform) in the order -x, +x, -y, +y, -z, +z, wound outward,
 * also where the transform mirrors. low < high on every axis. */
bool scene_build_box(SceneBuild *build, Vec3 low, Vec3 high);

/* Adds a note on a file, at a place. */
bool scene_build_note(SceneBuild *build, NoteName name, const char *path, NotePlace place);

/* "PATH: REASON", and what the notes say that the file holds instead of faces. Returns false. */
bool scene_build_fail_empty(SceneBuild *build, const char *path, const char *reason);

/* Adds a note on a face. */
bool scene_build_note_face(SceneBuild *build, NoteName name, int object, int place);

/* The same in one step for a reader that has put points and faces into the arrays itself, behind those that are there:
 * points as the file gives them; of faces the vertices' numbers within the object, their count, material and place.
 * scene_build_finish checks their shapes, and a box. False where one is not valid: then nothing is added. */
bool scene_build_adopt(SceneBuild *build, int points, int faces);
bool scene_build_adopt_box(SceneBuild *build, Vec3 low, Vec3 high);

/* The place of the next point or face where `behind` others are waiting to be adopted. NULL without memory. */
Vec3 *scene_build_next_point(SceneBuild *build, int behind);
SceneBuildFace *scene_build_next_face(SceneBuild *build, int behind);

/* Corner i of a box has the high x where bit 0 of i is set, the high y for bit 1, the high z for bit 2. */
enum { BUILD_BOX_POINTS = 8, BUILD_BOX_FACES = 6 };
Vec3 scene_build_corner(Vec3 low, Vec3 high, int i);
extern const int scene_build_box_faces[BUILD_BOX_FACES][4]; /* the corners of each face */

/* Moves faces, camera and lights to the scene's centre, rounds the faces and computes their planes. */
bool scene_build_finish(SceneBuild *build);

/* The last part of it: moves camera and lights to the scene's centre. */
bool scene_build_place(SceneBuild *build);

void scene_build_free(SceneBuild *build);

#endif
