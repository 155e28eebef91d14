/* A bounding volume hierarchy as the kernels walk it: a node has as many children as the lanes test at once, their
 * boxes side by side (Wald, Benthin, Boulos, "Getting Rid of Packets", 2008, section 3). Floor 4, below opencl.h. */
#ifndef RECTRAY_OPENCL_TREE_H
#define RECTRAY_OPENCL_TREE_H

#include "bvh.h"

typedef struct WideTree {
    float *boxes;  /* per node 6 x width: low x of all children, high x, low y, high y, low z, high z */
    int *children; /* per node `width`: see NO_CHILD and LEAF in kernels/layout.h; node 0 is the root */
    int width, node_count;
    int depth; /* of the deepest node; the root's is 1 */
} WideTree;

/* Collapses a binary tree: a node takes in the children of its largest child until it has `width`. */
bool wide_tree_build(WideTree *tree, const Bvh *bvh, int width, Error *error);
void wide_tree_free(WideTree *tree);

#endif
