/* Where a node of a bounding volume hierarchy is split, by the surface area heuristic. */
#ifndef RECTRAY_BVH_SPLIT_H
#define RECTRAY_BVH_SPLIT_H

#include "scene/box.h"

enum { BVH_BINS = 16, BVH_MAX_DEPTH = 96 };

/* What a step into a node costs, in face tests. */
#define BVH_NODE_COST 0.5

typedef struct FaceBox {
    Box box;
    int face;
} FaceBox;

/* Splits a node at some depth: puts the boxes of the left child first and returns how many they are; 0: a leaf. */
int bvh_split(Box node, FaceBox *boxes, int count, int depth);

/* All planes that are tried, for those who want to see the choice. */
typedef struct BvhCandidates {
    int axis, bin;                /* the cheapest; bin -1: there is none */
    double cost[3][BVH_BINS - 1]; /* in face tests of the node; infinite where middles fall together */
    int low[3][BVH_BINS - 1];     /* how many faces go left */
    float plane[3][BVH_BINS - 1]; /* those with their middles below it */
} BvhCandidates;

BvhCandidates bvh_split_candidates(Box node, const FaceBox *boxes, int count);

#endif
