/* In which order rays ask the faces: all of them, or those in the leaves of the tree that a bundle of rays meets. */
#include "shared/skips.h"
#include "shared/layout.h"
#include "packet/lanes.cl"
#include "packet/geometry.cl"
#include "packet/apex.cl"
#include "packet/intersect.cl"
#include "packet/points.cl"
#include "packet/world.cl"
#include "packet/accel.cl"
#include "packet/tree.cl"

INLINE bool any_packet(const Mask *masks)
{
    Mask any = masks[0];
    for (int p = 1; p < PACKETS; p++)
        any |= masks[p];
    return ANY(any);
}

/* How many faces a large group of rays may meet before it is cut into smaller ones, each of which goes on where the large one
 * stopped; tuned on the ladder of scenes. */
enum { NEAREST_BUDGET = 16, BLOCKED_BUDGET = 12 };
#define NO_BUDGET 0xffffffffu

/* Groups of shadow rays are cut so often, to directions that are as near to one another as this; the last ones are not cut. */
enum { NEAR_LEVELS = 3 };
#define NEAR_MOST ((real)0.1f)
#define NEAR_LESS ((real)0.125f)

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

/* The nearest faces ahead of one packet of any rays, exactly. */
static Hit find_nearest_apart(const World *world, const Ray *ray, Mask active)
{
    RealRay l = real_ray(vec_to_real(ray->origin), vec_to_real(ray->direction));
    Hit nearest = no_hit();
    uint lanes = mask_count(active);
    RayBounds b = bounds_of(&l, active);
    Stack stack = stack_of(world, &b);
    for (int first, count; next_leaf(world, &b, lanes, &stack, &first, &count);) {
        bool nearer = false;
        for (int k = first; k < first + count; k++)
            nearer |= intersect_nearest(world, &l, ray, active, face_in_leaf(world, k), &nearest);
        world->counters[COUNT_FACE_TESTS] += lanes * (uint)count;
        if (nearer) {
            Lanes t = TO_REAL(nearest.t_in_box < (Wide)REACH_ALL ? nearest.t_in_box : (Wide)REACH_ALL) * l.scale;
            bounds_shorten(&b, -lanes_lowest(active ? -t : (Lanes)0));
        }
    }
    return nearest;
}

/* The lanes whose ray starts where the first one's does. */
static Mask same_origin(const Ray *ray)
{
    WideVec o = ray->origin;
    return TO_MASK(IS(o.x == (Wide)first_wide(o.x)) & IS(o.y == (Wide)first_wide(o.y)) & IS(o.z == (Wide)first_wide(o.z)));
}

/* The same for rays that all start at one point. */
static Hit find_nearest_of_pencil(const World *world, const Ray *ray, Mask active)
{
    OriginPacket pencils[PACKETS];
    Nearest nearest[PACKETS];
    Ray rays[PACKETS];
    Mask close[PACKETS];
    Vec direction = vec_to_real(ray->direction);
    EACH_PACKET(p) {
        rays[p] = *ray;
        pencils[p].ahead = direction;
        pencils[p].active = p == 0 ? active : (Mask)0;
        pencils[p].left = (Mask)-1;
        nearest[p] = nothing_yet();
    }
    wide origin[3] = {first_wide(ray->origin.x), first_wide(ray->origin.y), first_wide(ray->origin.z)};
    Apex a = apex_at(origin, 0, -lanes_lowest(active ? -vec_magnitudes(direction) : (Lanes)0));
    RayBounds all = bounds_from(&a, pencils, PACKETS, 0);
    find_nearest_from(world, &a, pencils, rays, nearest, &all, 0, false, close);
    return exact_hit(world, ray, nearest, active);
}
