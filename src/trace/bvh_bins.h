/* The planes that may split a node of a bounding volume hierarchy: along each axis the middles of the boxes fall into
 * bins, and each plane between two bins is tried. */
#ifndef RECTRAY_BVH_BINS_H
#define RECTRAY_BVH_BINS_H

#include "trace/bounds.h"

enum { BVH_BINS = 16, BVH_SORTED = 8 };

/* How a middle becomes a bin. */
typedef struct Binning {
    float low[4], scale[4]; /* by axis, the last is 0; scale 0: all middles fall together */
} Binning;

/* middles: around the middles of the boxes. */
Binning binning_of(const Bounds *middles);

/* Where a box's middle lies among the bins of an axis whose scale is not 0: bin b is from b to b + 1. */
static inline float binning_place(const Binning *binning, const Bounds *box, int axis)
{
    return (box->least[axis] - box->least[4 + axis] - binning->low[axis]) * binning->scale[axis];
}

typedef struct Bins {
    Bounds boxes[3][BVH_BINS];
    int count[3][BVH_BINS];
} Bins;

void bins_fill(Bins *bins, const Binning *binning, const Bounds *boxes, int count);

typedef struct Split {
    int axis, bin; /* faces whose bin on the axis is <= bin go left */
    double cost;   /* sum over both sides of area * faces; infinite where no split was found */
} Split;

/* The cheapest of all planes; of equal ones the first. With `costs`, all are kept there. */
Split bins_best_split(const Bins *bins, const Binning *binning, double (*costs)[BVH_BINS - 1]);

/* The same split for up to BVH_SORTED boxes, without bins: the boxes are
 * sorted by the bin that they would fall into. Most nodes are so small. */
Split bins_best_split_sorted(const Binning *binning, const Bounds *boxes, int count);

#endif
