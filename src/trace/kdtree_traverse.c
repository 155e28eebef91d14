/* A ray's way through a k-d tree: a plane cuts the part of the ray that lies in a node's box into the part on its low
 * side and the part on its high side; the ray meets them in the order of its direction. */
#include "trace/kdtree.h"

static double component(Vec3 a, int axis)
{
    return axis == 0 ? a.x : axis == 1 ? a.y : a.z;
}

/* Walks the node whose box the ray is in during `inside`; false: the walk is over. */
static bool walk_node(const KdTree *tree, int index, int level, Interval inside, Walk *walk)
{
    const KdNode *node = &tree->nodes[index];
    bool enter = inside.enter <= inside.leave && inside.enter <= walk->limit;
    walk->box_tests++;
    if (walk->node)
        walk->node(walk, (WalkNode){index, level, node->axis == KDTREE_LEAF ? node->count : 0, enter});
    if (!enter)
        return true;

    if (node->axis == KDTREE_LEAF) {
        for (int i = 0; i < node->count; i++)
            if (!walk->visit(walk, tree->order[node->first + i]))
                return false;
        return true;
    }
    double origin = component(walk->origin, node->axis), direction = component(walk->direction, node->axis);
    double plane = (double)node->split;
    /* The plane itself belongs to both sides: a ray in it visits both. */
    Interval low = interval_common(inside, interval_between(-HUGE_VAL, plane, origin, direction));
    Interval high = interval_common(inside, interval_between(plane, HUGE_VAL, origin, direction));
    int below = index + 1, above = node->first;
    if (direction < 0)
        return walk_node(tree, above, level + 1, high, walk) && walk_node(tree, below, level + 1, low, walk);
    return walk_node(tree, below, level + 1, low, walk) && walk_node(tree, above, level + 1, high, walk);
}

void kdtree_walk(const KdTree *tree, Walk *walk)
{
    walk_node(tree, 0, 0, interval_in_box(tree->box, walk->origin, walk->direction), walk);
}
