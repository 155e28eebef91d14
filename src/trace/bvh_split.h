/* Where a node of a bounding volume hierarchy is split, by the surface area heuristic. */
#ifndef RECTRAY_BVH_SPLIT_H
#define RECTRAY_BVH_SPLIT_H

#include "trace/bvh_bins.h"

enum { BVH_MAX_DEPTH = 96 };

/* What a step into a node costs, in face tests. */
#define BVH_NODE_COST 0.5

/* The faces below a node, by their boxes. */
typedef struct BvhFaces {
    Bounds *boxes;
    int *faces; /* whose boxes they are */
    int count;
} BvhFaces;

/* Splits a node at some depth; `range`: of all its boxes. Puts the faces of the left child first and returns how many
 * they are, with the range of each side; 0: a leaf. */
int bvh_split(BvhFaces faces, int depth, const BoundsRange *range, BoundsRange sides[2]);

/* All planes that are tried, for those who want to see the choice. */
typedef struct BvhCandidates {
    int axis, bin;                /* the cheapest; bin -1: there is none */
    double cost[3][BVH_BINS - 1]; /* in face tests of the node; infinite where middles fall together */
    int low[3][BVH_BINS - 1];     /* how many faces go left */
    float plane[3][BVH_BINS - 1]; /* those with their middles below it */
} BvhCandidates;

BvhCandidates bvh_split_candidates(Box node, const Bounds *boxes, int count);

#endif
