/* Which shadow rays are blocked. The rays of a tile to one light are searched from the light, which they have in
 * common.
 *
 *     while there are rays
 *         take those whose directions are like that of the first one: a group
 *         for each leaf of the tree that the bounds of the group's rays meet
 *             for each face of the leaf
 *                 set it up once, as seen from the light, and test it packet by packet
 *                 rays that it blocks leave the group
 *         after BLOCKED_BUDGET faces: cut the group to directions that are more alike, and go on where it stopped
 *
 * A light in the middle of a scene sends its rays everywhere, and bounds of such rays would meet nearly all faces: so
 * groups are of like directions. Parts that go on from the stack that the group has left, instead of the root, visit
 * 20 to 49 % fewer nodes in cities and sponges. */
#include "shared/compiler.cl"
#include "shared/layout.h"
#include "shared/precision.cl"
#include "shared/skips.h"
#include "packet/accel.cl"
#include "packet/apex.cl"
#include "packet/faces.cl"
#include "packet/intersect.cl"
#include "packet/intersect_exactly.cl"
#include "packet/lanes.cl"
#include "packet/points.cl"
#include "packet/tree.cl"
#include "packet/vectors.cl"
#include "packet/world.cl"

/* A group that has tested so many faces is cut; tuned on the ladder of scenes. */
enum { BLOCKED_BUDGET = 12 };

/* The directions of a group differ by up to NEAR_MOST in each component. Each cut divides that by 8; groups that have
 * been cut NEAR_LEVELS - 1 times are not cut again. */
enum { NEAR_LEVELS = 3 };
#define NEAR_MOST ((real)0.1f)
#define NEAR_LESS ((real)0.125f)

/* The shadow rays of a tile to one light. */
typedef struct ShadowGroup {
    const wide *light;
    OriginPacket *packets; /* from the light to the points */
    LazyPoints *points;    /* the points themselves, for rays that arithmetic in `real` cannot decide */
    Mask *blocked;         /* collects the lanes that a face blocks, strictly between the point and the light */
} ShadowGroup;

/* The lanes of `rest` whose direction is like that of its first lane: no component differs by more than `near`. */
INLINE void like_first(const OriginPacket *packets, const Mask *rest, real near, Mask *like)
{
    int first = first_packet(rest), lane = lowest_bit(mask_bits(rest[first]));
    Vec ahead = packets[first].ahead;
    real x = real_at(ahead.x, lane), y = real_at(ahead.y, lane), z = real_at(ahead.z, lane);
    EACH_PACKET(p) {
        Vec d = packets[p].ahead;
        like[p] = rest[p] & IS(fabs(d.x - x) <= (Lanes)near) & IS(fabs(d.y - y) <= (Lanes)near) &
                  IS(fabs(d.z - z) <= (Lanes)near);
    }
}

/* Bounds of the active shadow rays, as far as they go. */
INLINE RayBounds bounds_of_shadow_rays(const Apex *a, const OriginPacket *packets)
{
    Lanes ends = (Lanes)REACH_ALL, slacks = (Lanes)1;
    EACH_PACKET(p) {
        const OriginPacket *packet = packets + p;
        ends = (packet->active & IS(packet->per_end < ends)) ? packet->per_end : ends;
        slacks = (packet->active & IS(packet->slack > slacks)) ? packet->slack : slacks;
    }
    real share = SHARE_OF(-lanes_lowest(-slacks));
    RayBounds b = bounds_from(a, packets, PACKETS, share);
    bounds_shorten(&b, (1 + 2 * share) / lanes_lowest(ends));
    return b;
}

/* Tests the faces that `stack` leads to for the active lanes of the group. Lanes that are blocked are active no more.
 * b: bounds of the rays. False: it stopped after more than `budget` faces, and the stack leads to the others. */
INLINE bool traverse_segments(const World *world, const Apex *a, const ShadowGroup *g, RayBounds b, Stack *stack,
                              uint budget, bool cull_boxes)
{
    uint active[PACKETS], lanes = 0, tested = 0;
    EACH_PACKET(p)
        lanes += active[p] = mask_count(g->packets[p].active);
    if (cull_boxes)
        bounds_cull_sides(&b, true);
    for (int first, count; tested <= budget && next_leaf(world, &b, lanes, stack, &first, &count);) {
        tested += (uint)count;
        for (int k = first; k < first + count; k++) {
            int i = face_in_leaf(world, k);
            world->counters[COUNT_FACE_TESTS] += lanes;
            FaceSetup face;
            Visibility visibility = setup_face(a, face_row(world, i), true, cull_boxes, &face);
            if (visibility == CULLED) {
                if (face.closed)
                    world->counters[COUNT_SKIPPED + SKIP_BACK_FACE] += lanes;
                continue;
            }
            EACH_PACKET(p) {
                if (active[p] == 0)
                    continue;
                OriginPacket *packet = g->packets + p;
                Mask hit = (Mask)0, uncertain = packet->active & IS(packet->from != (Mask)i);
                if (visibility == VISIBLE)
                    hit = intersect_segment_from(packet, &face, i, &uncertain);
                if (ANY(uncertain))
                    hit |= intersect_segment(world, shifted_point(g->points, p, uncertain), g->light, uncertain, i);
                if (ANY(hit)) {
                    g->blocked[p] |= hit;
                    packet->active &= ~hit;
                    lanes -= active[p];
                    lanes += active[p] = mask_count(packet->active);
                }
            }
            if (lanes == 0)
                return true;
        }
    }
    return tested <= budget;
}

/* Finds which of the `wanted` lanes are blocked. Half of the faces of closed boxes are culled. The lanes that are
 * `near_ties` come last, and for them all faces are tested. stack: leads to all faces that may block some lane; NULL:
 * the root does. */
NOINLINE void find_blocked(const World *world, const ShadowGroup *g, const Mask *wanted, const Mask *near_ties,
                           const Stack *stack)
{
    Apex a = apex_at(g->light, 0, 1 + 4 * REAL_ROUNDING);
    Mask rest[NEAR_LEVELS][PACKETS]; /* level 0: of all lanes; each next level: of a group that has been cut */
    Stack stacks[NEAR_LEVELS - 1];   /* what that group has left to test */
    real near = NEAR_MOST;
    bool cull_boxes = true;
    EACH_PACKET(p) {
        g->blocked[p] = (Mask)0;
        rest[0][p] = wanted[p] & ~near_ties[p];
    }
    for (int level = 0;;) {
        if (!any_packet(rest[level])) {
            if (level > 0) {
                level--;
                near /= NEAR_LESS;
                continue;
            }
            if (!cull_boxes)
                return;
            cull_boxes = false;
            EACH_PACKET(p)
                rest[0][p] = wanted[p] & near_ties[p];
            continue;
        }
        Mask group[PACKETS];
        like_first(g->packets, rest[level], near, group);
        EACH_PACKET(p) {
            rest[level][p] &= ~group[p];
            g->packets[p].active = group[p];
        }
        RayBounds b = bounds_of_shadow_rays(&a, g->packets);
        Stack left = level > 0 ? stacks[level - 1] : stack ? *stack : stack_of(world, &b);
        uint budget = level + 1 < NEAR_LEVELS ? BLOCKED_BUDGET : NO_BUDGET;
        if (!traverse_segments(world, &a, g, b, &left, budget, cull_boxes)) {
            stacks[level++] = left;
            near *= NEAR_LESS;
            EACH_PACKET(p)
                rest[level][p] = g->packets[p].active;
        }
    }
}
