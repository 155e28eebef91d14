/* How a tracer finds faces: one by one, or through a tree. To add a
 * tree, add a kind in render.h and a case to each function here. */
#ifndef RECTRAY_ACCEL_H
#define RECTRAY_ACCEL_H

#include "trace/bvh.h"
#include "trace/kdtree.h"
#include "trace/render.h"
#include "trace/traversal.h"

/* Scenes of fewer faces than this are traced face by face unless the user says otherwise. At twelve faces a tree makes
 * a ray a quarter faster, at forty four times as fast; below, there is nothing to win. */
enum { ACCEL_AUTO_FACES = 12 };

typedef struct Accel {
    AccelKind kind; /* what was built: ACCEL_AUTO only before, and ACCEL_BVH also for an ACCEL_LBVH */
    bool sorted;    /* the BVH was made by sorting */
    Bvh bvh;
    KdTree kdtree;
} Accel;

/* Builds what `kind` asks for; ACCEL_AUTO is a BVH, and none for small scenes. A scene without faces gets none. */
bool accel_build(Accel *accel, const Scene *scene, AccelKind kind, int threads, Error *error);
void accel_free(Accel *accel);

/* What a user calls the tree that there is: ACCEL_LBVH where it was made by sorting. */
AccelKind accel_name(const Accel *accel);

/* Are an ACCEL_LBVH and what the settings want of one picture made sooner than an ACCEL_BVH and the same? */
bool accel_sorting_pays(const Scene *scene, const RenderSettings *settings);

/* NULL, ACCEL_NONE and an Accel that was never built have none. */
bool accel_has_tree(const Accel *accel);

/* A node of either tree, by its number. */
typedef struct AccelNode {
    Box box; /* a k-d tree's is the part of space that its planes cut out */
    bool leaf;
    int faces;        /* of a leaf */
    const int *order; /* of a leaf: its faces */
    int axis;         /* of a k-d tree's inner node: 0, 1 or 2, across which its plane lies; else -1 */
    float split;      /* where the plane is */
    int low, high;    /* the children; of a k-d tree on the low and on the high side of the plane */
} AccelNode;

AccelNode accel_node(const Accel *accel, int index);

/* Traverses the tree that there is. */
void accel_traverse(const Accel *accel, Traversal *traversal);

#endif
