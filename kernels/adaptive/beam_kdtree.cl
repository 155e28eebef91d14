/* Beams in a k-d tree: the faces of those leaves are tested that no cut leaves out. */
#include "shared/compiler.cl"
#include "shared/layout.h"
#include "shared/precision.cl"
#include "packet/lanes.cl"
#include "packet/tree.cl"
#include "packet/world.cl"
#include "adaptive/beam_cuts.cl"
#include "adaptive/beam_query.cl"
#include "adaptive/group_beam.cl"

typedef struct KdBox {
    int node;
    real planes[6]; /* low x, high x, low y, ... */
} KdBox;

static bool box_is_left(const Cuts *cuts, const KdBox *box)
{
    real magnitude = 0;
    for (int axis = 0; axis < 3; axis++)
        magnitude += GREATER(fabs(box->planes[2 * axis]), fabs(box->planes[2 * axis + 1]));
    for (int i = 0; i < cuts->count; i++) {
        real height = -cuts->limit[i] - cuts->slack[i] * magnitude;
        for (int axis = 0; axis < 3; axis++)
            height += cuts->w[i][axis] * box->planes[cuts->lowest[i][axis]];
        if (height > 0)
            return false;
    }
    return true;
}

NOINLINE void traverse_beam(const World *world, BeamQuery *q)
{
    GroupBeam group = group_beam(world, q->beam);
    Cuts cuts;
    make_cuts(world, q, &group, &cuts);
    KdBox stack[STACK_SIZE];
    int count = 1;
    stack[0].node = 0;
    for (int k = 0; k < 6; k++)
        stack[0].planes[k] = world->tree_floats[k];
    while (count > 0) {
        KdBox box = stack[--count];
        world->counters[COUNT_BOX_TESTS]++;
        if (!box_is_left(&cuts, &box))
            continue;
        global const int *ints = world->tree_ints + 1 + (size_t)box.node * KD_INTS;
        int axis = ints[KD_AXIS];
        if (axis != KD_LEAF) {
            KdBox below = box, above = box;
            below.node = box.node + 1;
            above.node = ints[KD_FIRST];
            below.planes[2 * axis + 1] = above.planes[2 * axis] = world->tree_floats[6 + box.node];
            stack[count++] = above;
            stack[count++] = below;
            continue;
        }
        for (int i = ints[KD_FIRST]; i < ints[KD_FIRST] + ints[KD_COUNT] && q->active_count; i++)
            intersect_beam(world, q, &group, face_in_leaf(world, i));
        if (!q->active_count)
            return;
    }
}
