/* Where a node of a bounding volume hierarchy is split: the faces fall into bins by the middles of their boxes, and the
 * planes between bins are tried. */
#include "trace/bvh_split.h"

#include <float.h>
#include <math.h>
#include <stdbool.h>
#include <stddef.h>

/* The leaf size from which on a split is made even if it does not pay. */
enum { BINS = BVH_BINS, MAX_LEAF = 8 };

typedef struct Split {
    int axis, bin; /* faces whose bin on the axis is <= bin go left */
    double cost;   /* infinite where no split was found */
} Split;

/* Twice the middle of a box on an axis; where it is rounded matters to no picture. */
static float box_middle(const Box *box, int axis)
{
    return box->low[axis] + box->high[axis];
}

/* The range of the boxes' middles on each axis, and how to turn a middle into a bin. */
typedef struct Binning {
    float low[3], scale[3]; /* scale 0: all middles fall together */
} Binning;

static int bin_of(const Binning *binning, const Box *box, int axis)
{
    int bin = (int)((box_middle(box, axis) - binning->low[axis]) * binning->scale[axis]);
    return bin < BINS ? bin : BINS - 1;
}

static Binning binning_of(const FaceBox *boxes, int count)
{
    Box middles = box_empty();
    for (int i = 0; i < count; i++) {
        const Box *box = &boxes[i].box;
        float x = box_middle(box, 0), y = box_middle(box, 1), z = box_middle(box, 2);
        box_grow(&middles, &(Box){{x, y, z}, {x, y, z}});
    }
    Binning binning;
    for (int axis = 0; axis < 3; axis++) {
        float scale = (float)BINS / (middles.high[axis] - middles.low[axis]);
        binning.low[axis] = middles.low[axis];
        binning.scale[axis] = scale < FLT_MAX ? scale : 0;
    }
    return binning;
}

typedef struct Bin {
    Box box;
    int count;
} Bin;

/* Takes the cheapest of the BINS - 1 planes of one axis: cost = sum over sides of area * faces. With `costs`, all are
 * kept there. */
static void try_axis(const Bin *bins, int axis, Split *best, double *costs)
{
    double right_cost[BINS];
    Box box = box_empty();
    int count = 0;
    for (int i = BINS - 1; i > 0; i--) {
        box_grow(&box, &bins[i].box);
        count += bins[i].count;
        right_cost[i] = box_half_area(box) * count;
    }
    box = box_empty();
    count = 0;
    for (int i = 0; i < BINS - 1; i++) {
        box_grow(&box, &bins[i].box);
        count += bins[i].count;
        double cost = box_half_area(box) * count + right_cost[i + 1];
        if (costs)
            costs[i] = cost;
        if (cost < best->cost)
            *best = (Split){axis, i, cost};
    }
}

static Split best_split(const Binning *binning, const FaceBox *boxes, int count, double (*costs)[BINS - 1])
{
    Bin bins[3][BINS];
    for (int axis = 0; axis < 3; axis++)
        for (int i = 0; i < BINS; i++)
            bins[axis][i] = (Bin){box_empty(), 0};
    for (int i = 0; i < count; i++)
        for (int axis = 0; axis < 3; axis++) {
            Bin *bin = &bins[axis][bin_of(binning, &boxes[i].box, axis)];
            box_grow(&bin->box, &boxes[i].box);
            bin->count++;
        }
    Split best = {.cost = HUGE_VAL};
    for (int axis = 0; axis < 3; axis++)
        if (binning->scale[axis] > 0)
            try_axis(bins[axis], axis, &best, costs ? costs[axis] : NULL);
    return best;
}

/* Puts the left side's boxes first; returns how many they are. */
static int partition(FaceBox *boxes, int count, const Binning *binning, Split split)
{
    int left = 0, right = count;
    while (left < right) {
        if (bin_of(binning, &boxes[left].box, split.axis) <= split.bin) {
            left++;
        } else {
            FaceBox swapped = boxes[--right];
            boxes[right] = boxes[left];
            boxes[left] = swapped;
        }
    }
    return left;
}

/* Faces that fill more than this share of a node's surface, where they are at most
 * one in so many, are set apart from the others, whose boxes would grow to the
 * node's all the way down if they held one of them: the floor below a city. */
#define LARGE_SHARE 0.5
enum { LARGE_RARE = 32 };

/* Puts the large boxes first; returns how many they are, 0 where they are not rare. */
static int part_large(Box node, FaceBox *boxes, int count)
{
    double large_area = LARGE_SHARE * box_half_area(node);
    int large = 0;
    for (int i = 0; i < count; i++)
        large += box_half_area(boxes[i].box) > large_area;
    if (large * LARGE_RARE > count)
        return 0;
    for (int i = 0, place = 0; place < large; i++)
        if (box_half_area(boxes[i].box) > large_area) {
            FaceBox swapped = boxes[place];
            boxes[place++] = boxes[i];
            boxes[i] = swapped;
        }
    return large;
}

int bvh_split(Box node, FaceBox *boxes, int count, int depth)
{
    if (count == 1 || depth == BVH_MAX_DEPTH - 1)
        return 0;
    int large = count < LARGE_RARE || depth >= BVH_MAX_DEPTH - 32 ? 0 : part_large(node, boxes, count);
    if (large > 0)
        return large;
    Binning binning = binning_of(boxes, count);
    Split split = best_split(&binning, boxes, count, NULL);
    double area = box_half_area(node);
    bool pays = split.cost + BVH_NODE_COST * area < area * count;
    if (split.cost < HUGE_VAL && (pays || count > MAX_LEAF) && depth < BVH_MAX_DEPTH - 32)
        return partition(boxes, count, &binning, split);
    /* Middles that fall together, or a tree that grows too deep: halve what is still too much for a leaf. */
    return count > MAX_LEAF ? count / 2 : 0;
}

BvhCandidates bvh_split_candidates(Box node, const FaceBox *boxes, int count)
{
    Binning binning = binning_of(boxes, count);
    double costs[3][BINS - 1], area = box_half_area(node);
    for (int axis = 0; axis < 3; axis++)
        for (int i = 0; i < BINS - 1; i++)
            costs[axis][i] = HUGE_VAL;
    Split best = best_split(&binning, boxes, count, costs);
    int in_bin[3][BINS] = {{0}};
    for (int i = 0; i < count; i++)
        for (int axis = 0; axis < 3; axis++)
            in_bin[axis][binning.scale[axis] > 0 ? bin_of(&binning, &boxes[i].box, axis) : 0]++;
    BvhCandidates candidates = {.axis = best.axis, .bin = best.cost < HUGE_VAL ? best.bin : -1};
    for (int axis = 0; axis < 3; axis++)
        for (int i = 0; i < BINS - 1; i++) {
            bool there = binning.scale[axis] > 0;
            candidates.low[axis][i] = in_bin[axis][i] + (i > 0 ? candidates.low[axis][i - 1] : 0);
            candidates.cost[axis][i] = there ? BVH_NODE_COST + costs[axis][i] / area : HUGE_VAL;
            candidates.plane[axis][i] = there ? (binning.low[axis] + (float)(i + 1) / binning.scale[axis]) / 2 : 0;
        }
    return candidates;
}
