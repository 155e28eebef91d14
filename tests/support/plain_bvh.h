/* The hierarchy as the surface area heuristic states it, without any haste: every box is a Box, every pass is a loop of
 * its own, and one thread does all. The program's builder must make the same tree, node for node. */
#ifndef RECTRAY_TESTS_PLAIN_BVH_H
#define RECTRAY_TESTS_PLAIN_BVH_H

#include "trace/bvh.h"

/* Builds the tree of a scene with at least one face. Without memory it ends the program. */
Bvh plain_bvh(const Scene *scene);

#endif
