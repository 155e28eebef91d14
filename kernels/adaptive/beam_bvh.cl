/* Beams in a bounding volume hierarchy: the faces of those leaves are tested that no cut leaves out. */
#include "shared/compiler.cl"
#include "shared/layout.h"
#include "packet/lanes.cl"
#include "packet/world.cl"
#include "adaptive/beam_cuts.cl"
#include "adaptive/beam_query.cl"
#include "adaptive/group_beam.cl"

/* The boxes, side by side, that no cut leaves out. `planes` holds low x, high x, low y, ... of each. */
INLINE uint boxes_left(const Cuts *cuts, global const float *planes)
{
    Lanes magnitude = (Lanes)0;
    for (int axis = 0; axis < 3; axis++) {
        Lanes low = LOAD_FLOATS(planes + 2 * axis * NODE_WIDTH),
              high = LOAD_FLOATS(planes + (2 * axis + 1) * NODE_WIDTH);
        magnitude += GREATER(fabs(low), fabs(high));
    }
    Mask left = (Mask)-1;
    for (int i = 0; i < cuts->count; i++) {
        Lanes height = -FMA(cuts->slack[i], magnitude, cuts->limit[i]);
        for (int axis = 0; axis < 3; axis++)
            height = FMA(cuts->w[i][axis], LOAD_FLOATS(planes + cuts->lowest[i][axis] * NODE_WIDTH), height);
        left &= ~IS(height > (Lanes)0); /* NaN, from overflow, leaves nothing out */
    }
    return mask_bits(left);
}

NOINLINE void traverse_beam(const World *world, BeamQuery *q)
{
    GroupBeam group = group_beam(world, q->beam);
    Cuts cuts;
    make_cuts(world, q, &group, &cuts);
    int stack[STACK_SIZE], count = 0;
    stack[count++] = 0;
    while (count > 0) {
        int node = stack[--count];
        if (node < 0) {
            int first = LEAF_FIRST(node), faces = LEAF_COUNT(node);
            for (int i = first; i < first + faces && q->active_count; i++)
                intersect_beam(world, q, &group, i);
            if (!q->active_count)
                return;
            continue;
        }
        world->counters[COUNT_BOX_TESTS] += NODE_WIDTH;
        global const int *children = world->tree_ints + (size_t)node * NODE_WIDTH;
        for (int part = 0; part < NODE_WIDTH; part += LANES)
            for (uint met = boxes_left(&cuts, world->tree_floats + (size_t)node * (6 * NODE_WIDTH) + part); met;
                 met &= met - 1)
                if (children[part + lowest_bit(met)] != NO_CHILD)
                    stack[count++] = children[part + lowest_bit(met)];
    }
}
