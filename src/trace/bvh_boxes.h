/* The boxes of all faces, made on several threads: what a hierarchy is built of. */
#ifndef RECTRAY_BVH_BOXES_H
#define RECTRAY_BVH_BOXES_H

#include "scene/scene.h"
#include "trace/bounds.h"

#include <stdbool.h>

/* The faces are shared out to threads in pieces of so many. */
enum { BVH_PIECE = 16384 };

typedef struct BvhBoxes {
    Bounds *boxes;       /* one per face */
    BoundsRange *pieces; /* of each piece */
    BoundsRange all;
    int count, piece_count;
} BvhBoxes;

/* False without memory. Free them also then. */
bool bvh_boxes_make(BvhBoxes *boxes, const Scene *scene, int threads);
void bvh_boxes_free(BvhBoxes *boxes);

/* One behind the last face of a piece. */
static inline int bvh_boxes_end(const BvhBoxes *boxes, int piece)
{
    return piece + 1 < boxes->piece_count ? (piece + 1) * BVH_PIECE : boxes->count;
}

/* The range of all pieces. */
BoundsRange bvh_boxes_join(const BvhBoxes *boxes);

#endif
