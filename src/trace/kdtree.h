/* A k-d tree: space cut by planes across the axes, each face in every leaf that its box reaches into. Built by the
 * surface area heuristic in O(N log N) (Wald and Havran, "On building fast kd-Trees for Ray Tracing, and on doing that
 * in O(N log N)", 2006). */
#ifndef RECTRAY_KDTREE_H
#define RECTRAY_KDTREE_H

#include "scene/box.h"
#include "scene/scene.h"

enum { KDTREE_LEAF = 3, KDTREE_MAX_DEPTH = 48, KDTREE_MAX_COPIES = 8 };

/* An inner node is cut where the coordinate `axis` (0, 1, 2) is `split`; the child
 * on the low side is the node after it, the one on the high side the node `first`.
 * A leaf has `count` faces, order[first .. first + count - 1], ascending. */
typedef struct KdNode {
    float split;
    int axis; /* KDTREE_LEAF: a leaf */
    int first;
    int count;
} KdNode;

typedef struct KdTree {
    Box box;       /* of all faces */
    KdNode *nodes; /* the root is node 0 */
    int *order;
    int node_count, order_count;
} KdTree;

/* Builds the tree of a scene with at least one face on `threads` threads; the tree does not depend on their number.
 * Memory: 16 bytes per node and 4 per face of a leaf, together 30 to 80 per face of the scene; at most
 * KDTREE_MAX_COPIES of a scene's faces are in leaves, each counted once per leaf. While building, about 250 per face.
 * False with an ERROR_SYSTEM when there is not enough. */
bool kdtree_build(KdTree *tree, const Scene *scene, int threads, Error *error);
void kdtree_free(KdTree *tree);

#endif
