/* A voxel while a k-d tree is built: a box of space, the faces in it, and the events along each axis: where the box of
 * a face begins, ends, or lies in a plane. Events are sorted once; cutting a voxel keeps their order. Faces are cut as
 * their boxes: what a leaf holds then covers all of FaceTest.t_in_box. */
#ifndef RECTRAY_KDTREE_VOXEL_H
#define RECTRAY_KDTREE_VOXEL_H

#include "scene/box.h"
#include "scene/scene.h"

#include <stdint.h>

/* What a step into a node costs, in face tests. */
#define KDTREE_STEP_COST 1.0

typedef enum VoxelEventType { BOX_ENDS, BOX_PLANAR, BOX_BEGINS } VoxelEventType;

typedef struct VoxelEvent {
    float position;
    uint32_t code; /* 4 * place of the face in the voxel's list + type */
} VoxelEvent;

typedef struct Voxel {
    Box box;
    int face_count;
    int event_count[3];
    VoxelEvent *events[3]; /* by position; at most two per face; start of the one block that holds all lists */
    int *faces;            /* ascending */
} Voxel;

/* A plane that cuts a voxel, the number of faces on each side, and the cost of the cut in face tests. */
typedef struct VoxelCut {
    int axis;
    float position;
    bool planar_low; /* faces in the plane go to the low side */
    int low_count, high_count;
    double cost; /* infinite where there is nothing to cut */
} VoxelCut;

/* Where a face of the voxel goes: its place on each side, -1 where it is not. */
typedef struct VoxelPlaces {
    int low, high;
} VoxelPlaces;

/* The voxel of all faces. False, with nothing to free, when memory is short. */
bool voxel_of_scene(Voxel *voxel, const Scene *scene);

/* The cheapest cut by the surface area heuristic, all three axes in one sweep each. `each` is shown every cut that is
 * tried; NULL: nobody looks. */
VoxelCut voxel_best_cut(const Voxel *voxel, void (*each)(void *user, const VoxelCut *cut), void *user);

/* Cuts: the voxel becomes its high side, `low` gets memory of its own. `places` has room for each face of the voxel.
 * False, the voxel unchanged, when memory is short. */
bool voxel_cut(Voxel *voxel, const VoxelCut *cut, VoxelPlaces *places, Voxel *low);

/* A copy that takes no more memory than it needs. */
bool voxel_copy(Voxel *copy, const Voxel *voxel);
void voxel_free(Voxel *voxel);

#endif
