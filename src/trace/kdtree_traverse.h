/* A ray's way through a k-d tree. */
#ifndef RECTRAY_KDTREE_TRAVERSE_H
#define RECTRAY_KDTREE_TRAVERSE_H

#include "trace/kdtree.h"
#include "trace/traversal.h"

/* Shows the traversal the faces of each leaf that the ray meets,
 * nearest leaf first; a face in several leaves is shown for each. */
void kdtree_traverse(const KdTree *tree, Traversal *traversal);

#endif
