/* The nearest face of each ray of a tile, for rays from one apex.
 *
 *     all packets of the tile are one group
 *     for each leaf of the tree that the bounds of the group's rays meet, the nearest first
 *         for each face of the leaf
 *             set it up once, as seen from the apex, and test it packet by packet
 *         shorten the bounds to the farthest hit
 *     after NEAREST_BUDGET faces: each packet goes on by itself, where the group stopped
 *
 * The 64 rays of a tile share each visit of a node and each set-up of a face, which took a third from the time of the
 * scene `original`. Where faces are smaller than a pixel, sharing costs: without the budget, a city of 1.2 million
 * faces took 1.5 times as long. docs/kernels.md, section 8. */
#include "shared/compiler.cl"
#include "shared/layout.h"
#include "shared/precision.cl"
#include "shared/skips.h"
#include "packet/accel.cl"
#include "packet/apex.cl"
#include "packet/faces.cl"
#include "packet/intersect.cl"
#include "packet/lanes.cl"
#include "packet/rays.cl"
#include "packet/tree.cl"
#include "packet/world.cl"

/* A group that has tested so many faces is cut into packets; tuned on the ladder of scenes. */
enum { NEAREST_BUDGET = 16 };

/* What an interrupted search has left to test. */
typedef struct Traversal {
    Stack stack; /* of the tree's nodes and leaves */
    int face;    /* one face to be tested before those; -1: none */
} Traversal;

INLINE Traversal begin_traversal(const World *world, const RayBounds *b)
{
    Traversal traversal = {stack_of(world, b), -1};
    return traversal;
}

/* Packets that are searched together. */
typedef struct Group {
    int count;
    OriginPacket *packets;
    const Ray *rays;
    Nearest *nearest;
    Mask *near_ties; /* collects the lanes for which a culled face of a closed box might matter */
} Group;

/* `count` packets of a group, from packet p on. */
INLINE Group part_of_group(const Group *g, int p, int count)
{
    Group part = {count, g->packets + p, g->rays + p, g->nearest + p, g->near_ties + p};
    return part;
}

/* How far the active lanes have to look: to the farthest of their nearest hits. */
INLINE real farthest(const Nearest *n, Mask active)
{
    real lowest = lanes_lowest(active ? n->low : (Lanes)REACH_ALL);
    return lowest > 1 / REACH_ALL ? 1 / lowest : REACH_ALL;
}

/* Tests face i for packet p. True: it is nearer in some lane. */
INLINE bool intersect_packet(const World *world, const Group *g, int p, Visibility visibility, const FaceSetup *face,
                             int i)
{
    const OriginPacket *packet = g->packets + p;
    if (visibility == VISIBLE)
        return intersect_nearest_from(world, packet, g->rays + p, face, i, g->nearest + p, g->near_ties + p);
    g->near_ties[p] |= packet->active;
    Mask tested = packet->active & IS(packet->from != (Mask)i);
    return resolve_nearest_exactly(world, g->rays + p, tested, i, g->nearest + p);
}

/* Finds the nearest faces ahead of the group's active lanes among those that are still to be tested. b: bounds of its
 * rays. cull_boxes: see setup_face. False: it stopped after more than `budget` faces, and the traversal holds the
 * others. */
INLINE bool traverse_nearest(const World *world, const Apex *a, const Group *g, RayBounds b, Traversal *traversal,
                             uint budget, bool cull_boxes)
{
    real reach[PACKETS];
    uint lanes = 0, tested = 0;
    EACH_OF(p, g->count) {
        uint active = mask_count(g->packets[p].active);
        reach[p] = active ? farthest(g->nearest + p, g->packets[p].active) : 0;
        lanes += active;
    }
    if (lanes == 0)
        return true;
    if (cull_boxes)
        bounds_cull_sides(&b, false);
    for (int first, count; tested <= budget;) {
        bool single = traversal->face >= 0;
        if (single)
            count = 1;
        else if (!next_leaf(world, &b, lanes, &traversal->stack, &first, &count))
            break;
        tested += (uint)count;
        for (int k = 0; k < count; k++) {
            int i = single ? traversal->face : face_in_leaf(world, first + k);
            FaceSetup face;
            Visibility visibility = setup_face(a, face_row(world, i), false, cull_boxes, &face);
            if (visibility == CULLED) {
                if (face.closed)
                    world->counters[COUNT_SKIPPED + SKIP_BACK_FACE] += lanes;
                continue;
            }
            real farthest_reach = 0;
            EACH_OF(p, g->count) {
                if (reach[p] > 0) {
                    if (intersect_packet(world, g, p, visibility, &face, i))
                        reach[p] = farthest(g->nearest + p, g->packets[p].active);
                    farthest_reach = GREATER(farthest_reach, reach[p]);
                }
            }
            bounds_shorten(&b, farthest_reach);
        }
        traversal->face = -1;
    }
    world->counters[COUNT_FACE_TESTS] += lanes * tested;
    return tested <= budget;
}

/* Finds the nearest faces of a whole tile: of all its packets together, then of single packets where a group stops,
 * and then, for the lanes with near ties, among all faces once more. bounds: of all rays. resume: a search to go
 * on with; NULL: the whole tree. Afterwards the packets' active lanes are no longer what they were. There is one call
 * in a loop, so that the search is compiled once. */
COMPILED_ONCE void find_nearest_from(const World *world, const Apex *a, const Group *all, const RayBounds *bounds,
                                     const Traversal *resume, bool cull_boxes)
{
    EACH_PACKET(p)
        all->near_ties[p] = (Mask)0;
    int count = PACKETS; /* of the groups */
    uint budget = PACKETS > 1 ? NEAREST_BUDGET : NO_BUDGET;
    Traversal begin = resume ? *resume : begin_traversal(world, bounds);
    __attribute__((opencl_unroll_hint(1))) for (int p = 0; p < PACKETS; p += count) {
        Group group = part_of_group(all, p, count);
        RayBounds b = count < PACKETS ? bounds_from(a, group.packets, 1, 0) : *bounds;
        Traversal traversal = begin;
        if (!traverse_nearest(world, a, &group, b, &traversal, budget, cull_boxes)) {
            begin = traversal; /* next: packet 0, from here on */
            p = -1;
            count = 1;
            budget = NO_BUDGET;
        } else if (cull_boxes && p + count == PACKETS && any_packet(all->near_ties)) {
            cull_boxes = false; /* next: from the beginning */
            begin = begin_traversal(world, bounds);
            EACH_PACKET(k)
                all->packets[k].active = all->near_ties[k];
            p = -count;
        }
    }
}
