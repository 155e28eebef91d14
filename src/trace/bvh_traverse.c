/* A ray's way through a bounding volume hierarchy: a box that the ray misses is left out with all that is in it, the
 * nearer of two children comes first, so that what it holds may spare the farther one. */
#include "trace/bvh_traverse.h"

static Interval in_node(const Bvh *bvh, int index, Traversal *traversal)
{
    traversal->box_tests++;
    return interval_in_box(bvh->nodes[index].box, traversal->origin, traversal->direction);
}

/* A node whose box was tested, to say which child is nearer, before the other one ended the traversal. */
static bool leave_out(int index, int level, Interval inside, const Traversal *traversal)
{
    if (traversal->node)
        traversal->node(traversal, (TraversalNode){index, level, NODE_UNNEEDED, inside, traversal->limit});
    return false;
}

/* Traverses the node whose box the ray is in during `inside`; false: the traversal is over. */
static bool traverse_node(const Bvh *bvh, int index, int level, Interval inside, Traversal *traversal)
{
    const BvhNode *node = &bvh->nodes[index];
    NodeVerdict verdict = traversal_verdict(traversal, inside);
    if (traversal->node)
        traversal->node(traversal, (TraversalNode){index, level, verdict, inside, traversal->limit});
    if (verdict != NODE_ENTERED)
        return true;

    for (int i = 0; i < node->count; i++)
        if (!traversal->visit(traversal, bvh->order[node->first + i]))
            return false;
    if (node->count > 0)
        return true;

    int first = index + 1, second = node->first;
    Interval in_first = in_node(bvh, first, traversal), in_second = in_node(bvh, second, traversal);
    bool swap = in_second.enter < in_first.enter;
    int near = swap ? second : first, far = swap ? first : second;
    Interval in_near = swap ? in_second : in_first, in_far = swap ? in_first : in_second;
    if (!traverse_node(bvh, near, level + 1, in_near, traversal))
        return leave_out(far, level + 1, in_far, traversal);
    return traverse_node(bvh, far, level + 1, in_far, traversal);
}

void bvh_traverse(const Bvh *bvh, Traversal *traversal)
{
    traverse_node(bvh, 0, 0, in_node(bvh, 0, traversal), traversal);
}
