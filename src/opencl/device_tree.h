/* A tree as the kernels traverse it: two arrays. A node of the bounding volume hierarchy has as many children as the
 * lanes test at once, their boxes side by side (Wald, Benthin, Boulos, "Getting Rid of Packets", 2008, section 3). */
#ifndef RECTRAY_DEVICE_TREE_H
#define RECTRAY_DEVICE_TREE_H

#include "trace/accel.h"

#include <stddef.h>

typedef struct DeviceTree {
    float *floats; /* as kernels/packet/bvh.cl and kernels/packet/kdtree.cl say */
    int *ints;
    size_t float_count, int_count;
    int node_width; /* children per node of a BVH */
    int stack_size; /* nodes that a traversal may have to remember */
} DeviceTree;

/* How it is packed. */
typedef struct DevicePlan {
    const unsigned char *closed; /* of skip_closed_boxes, or NULL */
    int width;                   /* children per node: 4 to 16 */
    int threads;                 /* 0: one per processor; the arrays do not depend on them */
} DevicePlan;

/* Packs the tree that was built; where there is none, the arrays are empty. */
bool device_tree_pack(DeviceTree *tree, const Accel *accel, const DevicePlan *plan, Error *error);
void device_tree_free(DeviceTree *tree);

#endif
