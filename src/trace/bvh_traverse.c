/* A ray's way through a bounding volume hierarchy: a box that the ray misses is left out with all that is in it, the
 * nearer of two children comes first, so that what it holds may spare the farther one. */
#include "trace/bvh.h"

static Interval in_node(const Bvh *bvh, int index, Walk *walk)
{
    walk->box_tests++;
    return interval_in_box(bvh->nodes[index].box, walk->origin, walk->direction);
}

/* Walks the node whose box the ray is in during `inside`; false: the walk is over. */
static bool walk_node(const Bvh *bvh, int index, int level, Interval inside, Walk *walk)
{
    const BvhNode *node = &bvh->nodes[index];
    bool enter = inside.enter <= inside.leave && inside.enter <= walk->limit;
    if (walk->node)
        walk->node(walk, (WalkNode){index, level, node->count, enter});
    if (!enter)
        return true;

    for (int i = 0; i < node->count; i++)
        if (!walk->visit(walk, bvh->order[node->first + i]))
            return false;
    if (node->count > 0)
        return true;

    int first = index + 1, second = node->first;
    Interval in_first = in_node(bvh, first, walk), in_second = in_node(bvh, second, walk);
    if (in_second.enter < in_first.enter)
        return walk_node(bvh, second, level + 1, in_second, walk) && walk_node(bvh, first, level + 1, in_first, walk);
    return walk_node(bvh, first, level + 1, in_first, walk) && walk_node(bvh, second, level + 1, in_second, walk);
}

void bvh_walk(const Bvh *bvh, Walk *walk)
{
    walk_node(bvh, 0, 0, in_node(bvh, 0, walk), walk);
}
