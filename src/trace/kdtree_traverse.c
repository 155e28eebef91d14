/* A ray's way through a k-d tree: a plane cuts the part of the ray that lies in a node's box into the part on its low
 * side and the part on its high side; the ray meets them in the order of its direction. */
#include "trace/kdtree_traverse.h"

/* Traverses the node whose box the ray is in during `inside`; false: the traversal is over. */
static bool traverse_node(const KdTree *tree, int index, int level, Interval inside, Traversal *traversal)
{
    const KdNode *node = &tree->nodes[index];
    NodeVerdict verdict = traversal_verdict(traversal, inside);
    traversal->box_tests++;
    if (traversal->node)
        traversal->node(traversal, (TraversalNode){index, level, verdict, inside, traversal->limit});
    if (verdict != NODE_ENTERED)
        return true;

    if (node->axis == KDTREE_LEAF) {
        for (int i = 0; i < node->count; i++)
            if (!traversal->visit(traversal, tree->order[node->first + i]))
                return false;
        return true;
    }
    double origin = vec3_component(traversal->origin, node->axis),
           direction = vec3_component(traversal->direction, node->axis);
    double plane = (double)node->split;
    /* The plane itself belongs to both sides: a ray in it visits both. */
    Interval low = interval_common(inside, interval_between(-HUGE_VAL, plane, origin, direction));
    Interval high = interval_common(inside, interval_between(plane, HUGE_VAL, origin, direction));
    int below = index + 1, above = node->first;
    if (direction < 0)
        return traverse_node(tree, above, level + 1, high, traversal) &&
               traverse_node(tree, below, level + 1, low, traversal);
    return traverse_node(tree, below, level + 1, low, traversal) &&
           traverse_node(tree, above, level + 1, high, traversal);
}

void kdtree_traverse(const KdTree *tree, Traversal *traversal)
{
    traverse_node(tree, 0, 0, interval_in_box(tree->box, traversal->origin, traversal->direction), traversal);
}
