/* A bounding volume hierarchy: a binary tree of axis-aligned boxes over the faces, built by the surface area
 * heuristic (Goldsmith and Salmon 1987) with binning (Wald, "On fast Construction of SAH-based Bounding Volume
 * Hierarchies", 2007). */
#ifndef RECTRAY_BVH_H
#define RECTRAY_BVH_H

#include "scene/box.h"
#include "scene/scene.h"
#include "trace/bvh_split.h"

/* A leaf has count > 0 faces, order[first .. first + count - 1]. An inner node has count 0; its children are the node
 * after it and the node `first`. */
typedef struct BvhNode {
    Box box;
    int first;
    int count;
} BvhNode;

typedef struct Bvh {
    BvhNode *nodes; /* 2 * face_count of them, not all in use; the root is node 0 */
    int *order;     /* the faces in the order of the leaves */
    int face_count;
} Bvh;

/* Builds the tree of a scene with at least one face on `threads` threads; the tree does not depend on their number.
 * Memory: 68 bytes per face, and 32 more while building. False with an ERROR_SYSTEM when there is not enough. */
bool bvh_build(Bvh *bvh, const Scene *scene, int threads, Error *error);
void bvh_free(Bvh *bvh);

/* For builders: room for a tree, false without memory; free it also then. And a leaf of the faces that stand in the
 * order from `first` on, which it sorts by their numbers. */
bool bvh_allocate(Bvh *bvh, int face_count);
void bvh_make_leaf(Bvh *bvh, int node, int first, int count);

#endif
