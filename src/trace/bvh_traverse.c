/* A ray's way through a bounding volume hierarchy: a box that the ray misses is left out with all that is in it, the
 * nearer of two children comes first, so that what it holds may spare the farther one. */
#include "trace/bvh_traverse.h"

static Interval in_node(const Bvh *bvh, int index, Traversal *traversal)
{
    traversal->box_tests++;
    return interval_in_box(bvh->nodes[index].box, traversal->origin, traversal->direction);
}

/* Traverses the node whose box the ray is in during `inside`; false: the traversal is over. */
static bool traverse_node(const Bvh *bvh, int index, int level, Interval inside, Traversal *traversal)
{
    const BvhNode *node = &bvh->nodes[index];
    bool enter = inside.enter <= inside.leave && inside.enter <= traversal->limit;
    if (traversal->node)
        traversal->node(traversal, (TraversalNode){index, level, node->count, enter});
    if (!enter)
        return true;

    for (int i = 0; i < node->count; i++)
        if (!traversal->visit(traversal, bvh->order[node->first + i]))
            return false;
    if (node->count > 0)
        return true;

    int first = index + 1, second = node->first;
    Interval in_first = in_node(bvh, first, traversal), in_second = in_node(bvh, second, traversal);
    if (in_second.enter < in_first.enter)
        return traverse_node(bvh, second, level + 1, in_second, traversal) &&
               traverse_node(bvh, first, level + 1, in_first, traversal);
    return traverse_node(bvh, first, level + 1, in_first, traversal) &&
           traverse_node(bvh, second, level + 1, in_second, traversal);
}

void bvh_traverse(const Bvh *bvh, Traversal *traversal)
{
    traverse_node(bvh, 0, 0, in_node(bvh, 0, traversal), traversal);
}
