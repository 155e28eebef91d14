/* Where a node of a bounding volume hierarchy is split: large faces are set apart, else the cheapest plane is taken. */
#include "trace/bvh_split.h"

#include <math.h>
#include <stdbool.h>
#include <stddef.h>

/* The leaf size from which on a split is made even if it does not pay. */
enum { MAX_LEAF = 8 };

/* Faces that fill more than this share of a node's surface, where they are at most
 * one in so many, are set apart from the others, whose boxes would grow to the
 * node's all the way down if they held one of them: the floor below a city. */
#define LARGE_SHARE 0.5
enum { LARGE_RARE = 32 };

static void swap_faces(BvhFaces faces, int i, int k)
{
    Bounds box = faces.boxes[i];
    faces.boxes[i] = faces.boxes[k];
    faces.boxes[k] = box;
    int face = faces.faces[i];
    faces.faces[i] = faces.faces[k];
    faces.faces[k] = face;
}

/* Can a face be so large? It lies in a bin on each axis, and is no larger than the box of that bin. */
static bool may_be_large(const Bins *bins, double large_area)
{
    bool possible = true;
    for (int axis = 0; axis < 3 && possible; axis++) {
        possible = false;
        for (int i = 0; i < BVH_BINS && !possible; i++)
            possible = bounds_half_area(&bins->boxes[axis][i]) > large_area;
    }
    return possible;
}

/* How many faces are to be set apart: 0 where the large ones are not rare. */
static int count_large(BvhFaces faces, const Bins *bins, double large_area)
{
    int large = 0;
    if (may_be_large(bins, large_area))
        for (int i = 0; i < faces.count; i++)
            large += bounds_half_area(&faces.boxes[i]) > large_area;
    return large * LARGE_RARE > faces.count ? 0 : large;
}

/* Puts so many large faces first. */
static void part_large(BvhFaces faces, int large, double large_area, BoundsRange sides[2])
{
    for (int i = 0, place = 0; place < large; i++)
        if (bounds_half_area(&faces.boxes[i]) > large_area)
            swap_faces(faces, i, place++);
    sides[0] = bounds_range_of(faces.boxes, large);
    sides[1] = bounds_range_of(faces.boxes + large, faces.count - large);
}

/* Puts the left side's faces first; returns how many they are. */
static int partition(BvhFaces faces, const Binning *binning, Split split, BoundsRange sides[2])
{
    const float end = (float)(split.bin + 1);
    BoundsRange low = bounds_range_empty(), high = bounds_range_empty();
    int left = 0, right = faces.count;
    while (left < right) {
        const Bounds *box = &faces.boxes[left];
        Bounds middle = bounds_middle(box);
        if (binning_place(binning, box, split.axis) < end) {
            bounds_grow(&low.boxes, box);
            bounds_grow(&low.middles, &middle);
            left++;
        } else {
            bounds_grow_before(&high.boxes, box);
            bounds_grow_before(&high.middles, &middle);
            swap_faces(faces, left, --right);
        }
    }
    sides[0] = low;
    sides[1] = high;
    return left;
}

int bvh_split(BvhFaces faces, int depth, const BoundsRange *range, BoundsRange sides[2])
{
    int count = faces.count;
    if (count == 1 || depth == BVH_MAX_DEPTH - 1)
        return 0;
    double area = bounds_half_area(&range->boxes);
    Binning binning = binning_of(&range->middles);
    Split split;
    if (count > BVH_SORTED) {
        Bins bins;
        bins_fill(&bins, &binning, faces.boxes, count);
        bool apart = count >= LARGE_RARE && depth < BVH_MAX_DEPTH - 32;
        int large = apart ? count_large(faces, &bins, LARGE_SHARE * area) : 0;
        if (large > 0) {
            part_large(faces, large, LARGE_SHARE * area, sides);
            return large;
        }
        split = bins_best_split(&bins, &binning, NULL);
    } else {
        split = bins_best_split_sorted(&binning, faces.boxes, count);
    }
    bool pays = split.cost + BVH_NODE_COST * area < area * count;
    if (split.cost < HUGE_VAL && (pays || count > MAX_LEAF) && depth < BVH_MAX_DEPTH - 32)
        return partition(faces, &binning, split, sides);
    if (count <= MAX_LEAF)
        return 0;
    /* Middles that fall together, or a tree that grows too deep: halve what is still too much for a leaf. */
    sides[0] = bounds_range_of(faces.boxes, count / 2);
    sides[1] = bounds_range_of(faces.boxes + count / 2, count - count / 2);
    return count / 2;
}

BvhCandidates bvh_split_candidates(Box node, const Bounds *boxes, int count)
{
    BoundsRange range = bounds_range_of(boxes, count);
    Binning binning = binning_of(&range.middles);
    Bins bins;
    bins_fill(&bins, &binning, boxes, count);
    double costs[3][BVH_BINS - 1], area = box_half_area(node);
    for (int axis = 0; axis < 3; axis++)
        for (int i = 0; i < BVH_BINS - 1; i++)
            costs[axis][i] = HUGE_VAL;
    Split best = bins_best_split(&bins, &binning, costs);
    BvhCandidates candidates = {.axis = best.axis, .bin = best.cost < HUGE_VAL ? best.bin : -1};
    for (int axis = 0; axis < 3; axis++)
        for (int i = 0; i < BVH_BINS - 1; i++) {
            bool there = binning.scale[axis] > 0;
            candidates.low[axis][i] = bins.count[axis][i] + (i > 0 ? candidates.low[axis][i - 1] : 0);
            candidates.cost[axis][i] = there ? BVH_NODE_COST + costs[axis][i] / area : HUGE_VAL;
            candidates.plane[axis][i] = there ? (binning.low[axis] + (float)(i + 1) / binning.scale[axis]) / 2 : 0;
        }
    return candidates;
}
