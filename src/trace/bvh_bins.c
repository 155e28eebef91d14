/* The planes that may split a node of a bounding volume hierarchy, and what each costs. */
#include "trace/bvh_bins.h"

#include <float.h>
#include <math.h>
#include <stddef.h>

Binning binning_of(const Bounds *middles)
{
    Binning binning = {{0}, {0}};
    for (int axis = 0; axis < 3; axis++) {
        float scale = (float)BVH_BINS / (-middles->least[4 + axis] - middles->least[axis]);
        binning.low[axis] = middles->least[axis];
        binning.scale[axis] = scale < FLT_MAX ? scale : 0;
    }
    return binning;
}

/* The box's bin on each axis. The last holds its upper end, too. */
static inline void bins_of(const Binning *binning, const Bounds *box, int *bins)
{
    const float last = BVH_BINS - 1;
    for (int i = 0; i < 4; i++) {
        float bin = (box->least[i] - box->least[4 + i] - binning->low[i]) * binning->scale[i];
        bins[i] = (int)(bin < last ? bin : last);
    }
}

/* Written out for each axis below: with a loop over the three, building takes 6 % longer. */
static inline void put(Bins *bins, int axis, int bin, const Bounds *box)
{
    bounds_grow(&bins->boxes[axis][bin], box);
    bins->count[axis][bin]++;
}

void bins_fill(Bins *bins, const Binning *binning, const Bounds *boxes, int count)
{
    for (int axis = 0; axis < 3; axis++)
        for (int i = 0; i < BVH_BINS; i++) {
            bins->boxes[axis][i] = bounds_empty();
            bins->count[axis][i] = 0;
        }
    for (int i = 0; i < count; i++) {
        const Bounds box = boxes[i];
        int bin[4];
        bins_of(binning, &box, bin);
        put(bins, 0, bin[0], &box);
        put(bins, 1, bin[1], &box);
        put(bins, 2, bin[2], &box);
    }
}

static void try_axis(const Bins *bins, int axis, Split *best, double *costs)
{
    double right_cost[BVH_BINS];
    Bounds box = bounds_empty();
    int count = 0;
    for (int i = BVH_BINS - 1; i > 0; i--) {
        bounds_grow(&box, &bins->boxes[axis][i]);
        count += bins->count[axis][i];
        right_cost[i] = bounds_half_area(&box) * count;
    }
    box = bounds_empty();
    count = 0;
    for (int i = 0; i < BVH_BINS - 1; i++) {
        bounds_grow(&box, &bins->boxes[axis][i]);
        count += bins->count[axis][i];
        double cost = bounds_half_area(&box) * count + right_cost[i + 1];
        if (costs)
            costs[i] = cost;
        if (cost < best->cost)
            *best = (Split){axis, i, cost};
    }
}

Split bins_best_split(const Bins *bins, const Binning *binning, double (*costs)[BVH_BINS - 1])
{
    Split best = {.cost = HUGE_VAL};
    for (int axis = 0; axis < 3; axis++)
        if (binning->scale[axis] > 0)
            try_axis(bins, axis, &best, costs ? costs[axis] : NULL);
    return best;
}

/* Of planes with no box between them, only the first is tried: they cost the same. */
static void try_axis_sorted(const int (*bins)[4], const Bounds *boxes, int count, int axis, Split *best)
{
    int order[BVH_SORTED];
    for (int i = 0; i < count; i++) {
        int place = i;
        for (; place > 0 && bins[order[place - 1]][axis] > bins[i][axis]; place--)
            order[place] = order[place - 1];
        order[place] = i;
    }
    double right_cost[BVH_SORTED];
    Bounds box = bounds_empty();
    for (int i = count - 1; i > 0; i--) {
        bounds_grow(&box, &boxes[order[i]]);
        if (bins[order[i - 1]][axis] < bins[order[i]][axis])
            right_cost[i] = bounds_half_area(&box) * (count - i);
    }
    box = bounds_empty();
    for (int i = 0; i < count - 1; i++) {
        bounds_grow(&box, &boxes[order[i]]);
        if (bins[order[i]][axis] == bins[order[i + 1]][axis])
            continue;
        double cost = bounds_half_area(&box) * (i + 1) + right_cost[i + 1];
        if (cost < best->cost)
            *best = (Split){axis, bins[order[i]][axis], cost};
    }
}

Split bins_best_split_sorted(const Binning *binning, const Bounds *boxes, int count)
{
    int bins[BVH_SORTED][4];
    for (int i = 0; i < count; i++)
        bins_of(binning, &boxes[i], bins[i]);
    Split best = {.cost = HUGE_VAL};
    for (int axis = 0; axis < 3; axis++)
        if (binning->scale[axis] > 0)
            try_axis_sorted((const int(*)[4])bins, boxes, count, axis, &best);
    return best;
}
