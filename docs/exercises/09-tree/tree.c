/* Exercise 9, a k-d tree. The README beside this file tells the task.
 *
 * What you may use, all of it short, in src/scene/box.h, src/trace/kdtree.h and src/trace/traversal.h:
 *     Box                                   box.low[axis] and box.high[axis], floats; axis is 0 for x, 1 for y, 2 for z
 *     Interval                              the part of a ray from t = enter to t = leave; none where enter > leave
 *     interval_between(low, high, o, r)     the part that lies between two planes across an axis, of a ray whose origin
 *                                           and direction have the coordinates o and r along this axis
 *     interval_common(a, b)                 what two parts have in common
 *     vec3_component(v, axis)               x, y or z of a vector
 *     HUGE_VAL                              infinity
 *     Cut                                   what the second function gives back
 */
#include "exercises/09/tree.h"

/* What it costs, in face tests, to cut the box by the plane where the coordinate `axis` is `position`, when low_count
 * faces are on the low side and high_count faces on the high side:
 *     1 + (A1 low_count + A2 high_count) / A
 * where A, A1 and A2 are the surfaces of the whole, of the low part and of the high part, and the 1 is the step down.
 * A cut with no face at all on one side counts 0.8 of that. */
static double cut_cost(Box box, int axis, float position, int low_count, int high_count)
{
    /* Your lines. */
    return NAN;
}

/* The cheapest cut of the box. `faces` are the boxes of the faces in it, all within the box.
 *
 * Try, for each of the three axes, the planes through both sides of each face's box. A face is on the low side if its
 * box begins below the plane, on the high side if it ends above the plane, so it may be on both sides. Faces that are
 * flat and lie in the plane are on neither: put all of them on the low side, or all on the high side, and try both.
 * A plane in a side of the box itself is a cut only if the part without any thickness gets a face. An axis along which
 * the box has no thickness has no cut.
 * Of equal costs take any. Where no cut is possible, give back one whose cost is HUGE_VAL. */
static Cut best_cut(Box box, const Box *faces, int count)
{
    /* Your lines. */
    return (Cut){.cost = NAN};
}

/* Walks a ray through node `index` of the tree and all below it. The ray is in the box of this node during `part`.
 *
 * First count the node: way->box_tests++. Where the ray is never in its box, or enters it beyond t = way->limit, that
 * is all: give back true.
 * In a leaf, whose node->axis is KDTREE_LEAF, show its faces: way->visit(way, face) for the faces
 * tree->order[node->first] up to tree->order[node->first + node->count - 1]. It may lower way->limit. As soon as it
 * gives back false the search is over: give back false, and walk no further.
 * Else the plane where coordinate node->axis is node->split cuts `part` in two. The child on the low side is the node
 * index + 1, the one on the high side node->first. Walk through both, that which the ray comes to first: a ray whose
 * direction is less than 0 along the axis comes from the high side. Each child gets its own part of the ray.
 *
 * The ray is way->origin and way->direction. Gives back true, unless the search is over. */
static bool walk(const KdTree *tree, int index, Interval part, Traversal *way)
{
    /* Your lines. */
    return true;
}
