/* A bounding volume hierarchy made by sorting, for pictures of few rays: the faces stand in the order of a curve
 * through space, and each node parts its faces where the curve leaves one half of a cell for the other (Lauterbach et
 * al., "Fast BVH Construction on GPUs", 2009). It is built in a fifth of the time, and rays meet a few more nodes. */
#ifndef RECTRAY_BVH_MORTON_H
#define RECTRAY_BVH_MORTON_H

#include "trace/bvh.h"

/* More faces have no place in a key. */
enum { BVH_MORTON_MAX_FACES = 1 << 28 };

/* As bvh_build. Memory: 68 bytes per face, and 48 more while building. */
bool bvh_morton_build(Bvh *bvh, const Scene *scene, int threads, Error *error);

#endif
