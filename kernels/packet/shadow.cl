/* Which shadow rays are blocked. */
#include "shared/compiler.cl"
#include "shared/layout.h"
#include "shared/precision.cl"
#include "shared/skips.h"
#include "packet/accel.cl"
#include "packet/apex.cl"
#include "packet/intersect.cl"
#include "packet/lanes.cl"
#include "packet/points.cl"
#include "packet/tree.cl"
#include "packet/vectors.cl"
#include "packet/world.cl"

/* How many faces a group of shadow rays may meet before it is cut into smaller ones, each of which goes on where it stopped; tuned
 * on the ladder of scenes. */
enum { BLOCKED_BUDGET = 12 };

/* Groups of shadow rays are cut so often, to directions that are as near to one another as this; the last ones are not cut. */
enum { NEAR_LEVELS = 3 };
#define NEAR_MOST ((real)0.1f)
#define NEAR_LESS ((real)0.125f)

/* The active lanes whose direction is as like that of the first active one as `near` says, pencil by pencil. */
INLINE void like_first(const OriginPacket *pencils, const Mask *rest, real near, Mask *like)
{
    int first = 0;
    while (!ANY(rest[first]))
        first++;
    real x[LANES], y[LANES], z[LANES];
    STORE(pencils[first].ahead.x, x);
    STORE(pencils[first].ahead.y, y);
    STORE(pencils[first].ahead.z, z);
    int i = lowest_bit(mask_bits(rest[first]));
    EACH_PACKET(p) {
        Vec d = pencils[p].ahead;
        like[p] = rest[p] & IS(fabs(d.x - x[i]) <= (Lanes)near) & IS(fabs(d.y - y[i]) <= (Lanes)near) &
                  IS(fabs(d.z - z[i]) <= (Lanes)near);
    }
}

/* The bundle of shadow rays told from the apex, as far as they go. */
INLINE RayBounds bounds_of_shadow_rays(const Apex *a, const OriginPacket *pencils)
{
    Lanes ends = (Lanes)REACH_ALL, doubts = (Lanes)1;
    EACH_PACKET(p) {
        const OriginPacket *pencil = pencils + p;
        ends = (pencil->active & IS(pencil->per_end < ends)) ? pencil->per_end : ends;
        doubts = (pencil->active & IS(pencil->doubt > doubts)) ? pencil->doubt : doubts;
    }
    real share = SHARE_OF(-lanes_lowest(-doubts));
    RayBounds b = bounds_from(a, pencils, PACKETS, share);
    bounds_shorten(&b, (1 + 2 * share) / lanes_lowest(ends));
    return b;
}

/* blocked: collects the active lanes of the pencils whose segments from the point to the target, an apex, a face blocks,
 * strictly between the two, among the faces that `stack` leads to; they are active no more. False: after more than `budget`
 * faces it stopped; what it has not asked then is on the stack. */
INLINE bool traverse_segments(const World *world, const Apex *a, const wide *target, OriginPacket *pencils,
                              LazyPoints *points, Mask *blocked, RayBounds b, Stack *stack, uint budget,
                              bool cull_boxes)
{
    uint asking[PACKETS], lanes = 0, asked = 0;
    EACH_PACKET(p)
        lanes += asking[p] = mask_count(pencils[p].active);
    if (cull_boxes)
        bounds_cull_sides(&b, true);
    for (int first, count; asked <= budget && next_leaf(world, &b, lanes, stack, &first, &count);) {
        asked += (uint)count;
        for (int k = first; k < first + count; k++) {
            int i = face_in_leaf(world, k);
            world->counters[COUNT_FACE_TESTS] += lanes;
            FaceSetup face;
            Visibility visibility = setup_face(a, world->edges + (size_t)i * FACE_REALS, true, cull_boxes, &face);
            if (visibility == CULLED) {
                if (face.closed)
                    world->counters[COUNT_SKIPPED + SKIP_BACK_FACE] += lanes;
                continue;
            }
            EACH_PACKET(p) {
                if (asking[p] == 0)
                    continue;
                OriginPacket *pencil = pencils + p;
                Mask hit = (Mask)0, doubt = pencil->active & IS(pencil->left != (Mask)i);
                if (visibility == VISIBLE)
                    hit = intersect_segment_from(pencil, &face, i, &doubt);
                if (ANY(doubt))
                    hit |= intersect_segment(world, shifted_point(points, p, doubt), target, doubt, i);
                if (ANY(hit)) {
                    blocked[p] |= hit;
                    pencil->active &= ~hit;
                    lanes -= asking[p];
                    lanes += asking[p] = mask_count(pencil->active);
                }
            }
            if (lanes == 0)
                return true;
        }
    }
    return asked <= budget;
}

/* The same for the lanes `asking`, in groups of like directions: one that meets many faces is cut, and its parts go on where
 * it stopped. Those that are `close` come last, and all faces are asked for them. all: leads to what may block any of them, or
 * NULL: the root does. */
NOINLINE void find_blocked(const World *world, const wide *target, OriginPacket *pencils, LazyPoints *points,
                           const Mask *close, const Mask *asking, const Stack *all, Mask *blocked)
{
    Apex a = apex_at(target, 0, 1 + 4 * REAL_ROUNDING);
    Mask rest[NEAR_LEVELS][PACKETS]; /* level by level: first all, then those of the group above that has been cut */
    Stack stacks[NEAR_LEVELS - 1];   /* what that group has left */
    real near = NEAR_MOST;
    bool cull_boxes = true;
    EACH_PACKET(p) {
        blocked[p] = (Mask)0;
        rest[0][p] = asking[p] & ~close[p];
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
                rest[0][p] = asking[p] & close[p];
            continue;
        }
        Mask group[PACKETS];
        like_first(pencils, rest[level], near, group);
        EACH_PACKET(p) {
            rest[level][p] &= ~group[p];
            pencils[p].active = group[p];
        }
        RayBounds b = bounds_of_shadow_rays(&a, pencils);
        Stack stack = level > 0 ? stacks[level - 1] : all ? *all : stack_of(world, &b);
        uint budget = level + 1 < NEAR_LEVELS ? BLOCKED_BUDGET : NO_BUDGET;
        if (!traverse_segments(world, &a, target, pencils, points, blocked, b, &stack, budget, cull_boxes)) {
            stacks[level++] = stack;
            near *= NEAR_LESS;
            EACH_PACKET(p)
                rest[level][p] = pencils[p].active;
        }
    }
}
