/* Fails at stops_when_told: the walk goes on although that of a child gave back false. */
#include "exercises/09/tree.h"

static double side(Box box, int axis)
{
    return (double)box.high[axis] - (double)box.low[axis];
}

static double surface(Box box)
{
    return side(box, 0) * side(box, 1) + side(box, 1) * side(box, 2) + side(box, 2) * side(box, 0);
}

static double cut_cost(Box box, int axis, float position, int low_count, int high_count)
{
    Box low = box, high = box;
    low.high[axis] = position;
    high.low[axis] = position;
    double cost = 1 + (surface(low) * low_count + surface(high) * high_count) / surface(box);
    return low_count == 0 || high_count == 0 ? 0.8 * cost : cost;
}

static void try_cut(Box box, const Box *faces, int count, Cut cut, Cut *best)
{
    for (int flat_low = 0; flat_low < 2; flat_low++) {
        cut.low_count = cut.high_count = 0;
        for (int i = 0; i < count; i++) {
            float low = faces[i].low[cut.axis], high = faces[i].high[cut.axis];
            if (low == high && low == cut.position) {
                cut.low_count += flat_low;
                cut.high_count += 1 - flat_low;
            }
            cut.low_count += low < cut.position;
            cut.high_count += high > cut.position;
        }
        if (cut.position == box.low[cut.axis] && cut.low_count == 0)
            continue;
        if (cut.position == box.high[cut.axis] && cut.high_count == 0)
            continue;
        cut.cost = cut_cost(box, cut.axis, cut.position, cut.low_count, cut.high_count);
        if (cut.cost < best->cost)
            *best = cut;
    }
}

static Cut best_cut(Box box, const Box *faces, int count)
{
    Cut best = {.cost = HUGE_VAL};
    for (int axis = 0; axis < 3; axis++)
        for (int i = 0; i < count && box.low[axis] < box.high[axis]; i++) {
            try_cut(box, faces, count, (Cut){.axis = axis, .position = faces[i].low[axis]}, &best);
            try_cut(box, faces, count, (Cut){.axis = axis, .position = faces[i].high[axis]}, &best);
        }
    return best;
}

static bool walk(const KdTree *tree, int index, Interval part, Traversal *way)
{
    const KdNode *node = &tree->nodes[index];
    way->box_tests++;
    if (part.enter > part.leave || part.enter > way->limit)
        return true;
    if (node->axis == KDTREE_LEAF) {
        for (int i = 0; i < node->count; i++)
            if (!way->visit(way, tree->order[node->first + i]))
                return false;
        return true;
    }
    double o = vec3_component(way->origin, node->axis), r = vec3_component(way->direction, node->axis);
    Interval low = interval_common(part, interval_between(-HUGE_VAL, (double)node->split, o, r));
    Interval high = interval_common(part, interval_between((double)node->split, HUGE_VAL, o, r));
    walk(tree, r < 0 ? node->first : index + 1, r < 0 ? high : low, way);
    walk(tree, r < 0 ? index + 1 : node->first, r < 0 ? low : high, way);
    return true;
}
