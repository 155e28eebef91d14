/* A ray's way through a bounding volume hierarchy. */
#ifndef RECTRAY_BVH_TRAVERSE_H
#define RECTRAY_BVH_TRAVERSE_H

#include "trace/bvh.h"
#include "trace/traversal.h"

/* Shows the traversal the faces of each leaf whose box the ray meets. */
void bvh_traverse(const Bvh *bvh, Traversal *traversal);

#endif
