/* The nearest faces of rays from one apex. */
#include "shared/compiler.cl"
#include "shared/layout.h"
#include "shared/precision.cl"
#include "shared/skips.h"
#include "packet/accel.cl"
#include "packet/apex.cl"
#include "packet/intersect.cl"
#include "packet/lanes.cl"
#include "packet/rays.cl"
#include "packet/tree.cl"
#include "packet/world.cl"

/* How many faces a tile of rays may meet before it is cut into packets, each of which goes on where the tile stopped; tuned on the
 * ladder of scenes. */
enum { NEAREST_BUDGET = 16 };

/* How far active lanes have to look: to the farthest of their nearest hits. */
INLINE real farthest(const Nearest *n, Mask active)
{
    real lowest = lanes_lowest(active ? n->low : (Lanes)REACH_ALL);
    return lowest > 1 / REACH_ALL ? 1 / lowest : REACH_ALL;
}

/* What a search of all rays of a tile has left to be asked: what `stack` leads to, and one face, -1: none. */
typedef struct Traversal {
    Stack stack;
    int face;
} Traversal;

INLINE Traversal begin_traversal(const World *world, const RayBounds *b)
{
    Traversal rest = {stack_of(world, b), -1};
    return rest;
}

/* The nearest faces ahead of the active lanes of the pencils, which come from one apex, among the rest. False: after more than
 * `budget` faces it stopped; what it has not asked then is in `rest`. `outside`: as setup_face. close: collects the lanes that
 * might need what is left out. */
INLINE bool traverse_nearest(const World *world, const Apex *a, const OriginPacket *pencils, const Ray *rays,
                             Nearest *nearest, RayBounds b, Traversal *rest, int packets, uint budget,
                             bool cull_boxes, Mask *close)
{
    real reach[PACKETS];
    uint lanes = 0, asked = 0;
    EACH_OF(p, packets) {
        uint asking = mask_count(pencils[p].active);
        reach[p] = asking ? farthest(nearest + p, pencils[p].active) : 0;
        lanes += asking;
    }
    if (lanes == 0)
        return true;
    if (cull_boxes)
        bounds_cull_sides(&b, false);
    for (int first, count; asked <= budget;) {
        bool single = rest->face >= 0;
        if (single)
            count = 1;
        else if (!next_leaf(world, &b, lanes, &rest->stack, &first, &count))
            break;
        asked += (uint)count;
        for (int k = 0; k < count; k++) {
            int i = single ? rest->face : face_in_leaf(world, first + k);
            FaceSetup face;
            Visibility visibility = setup_face(a, world->edges + (size_t)i * FACE_REALS, false, cull_boxes, &face);
            if (visibility == CULLED) {
                if (face.closed)
                    world->counters[COUNT_SKIPPED + SKIP_BACK_FACE] += lanes;
                continue;
            }
            real farthest_reach = 0;
            EACH_OF(p, packets) {
                if (reach[p] > 0) {
                    const OriginPacket *pencil = pencils + p;
                    if (visibility == UNCERTAIN)
                        close[p] |= pencil->active;
                    bool nearer = visibility == VISIBLE
                                      ? intersect_nearest_from(world, pencil, rays + p, &face, i, nearest + p, close + p)
                                      : resolve_nearest_exactly(world, rays + p, pencil->active & IS(pencil->left != (Mask)i), i, nearest + p);
                    if (nearer)
                        reach[p] = farthest(nearest + p, pencil->active);
                    farthest_reach = GREATER(farthest_reach, reach[p]);
                }
            }
            bounds_shorten(&b, farthest_reach);
        }
        rest->face = -1;
    }
    world->counters[COUNT_FACE_TESTS] += lanes * asked;
    return asked <= budget;
}

/* The same for all packets among what is left, NULL: all; where together they meet too many faces, each goes on by itself.
 * Then all is asked anew for the lanes in which what was left out might matter, which `close` collects. all: the bundle of all
 * rays. What is active in the pencils does not stay. */
INLINE void find_nearest_from(const World *world, const Apex *a, OriginPacket *pencils, const Ray *rays,
                              Nearest *nearest, const RayBounds *all, const Traversal *left, bool cull_boxes,
                              Mask *close)
{
    EACH_PACKET(p)
        close[p] = (Mask)0;
    int packets = PACKETS;
    uint budget = PACKETS > 1 ? NEAREST_BUDGET : NO_BUDGET;
    Traversal rest = left ? *left : begin_traversal(world, all);
    __attribute__((opencl_unroll_hint(1))) for (int p = 0; p < PACKETS; p += packets) {
        RayBounds b = packets < PACKETS ? bounds_from(a, pencils + p, 1, 0) : *all;
        Traversal here = rest;
        if (!traverse_nearest(world, a, pencils + p, rays + p, nearest + p, b, &here, packets, budget, cull_boxes, close + p)) {
            rest = here;
            p = -1;
            packets = 1;
            budget = NO_BUDGET;
        } else if (cull_boxes && p + packets == PACKETS && any_packet(close)) {
            cull_boxes = false;
            rest = begin_traversal(world, all);
            EACH_PACKET(k)
                pencils[k].active = close[k];
            p = -packets;
        }
    }
}
