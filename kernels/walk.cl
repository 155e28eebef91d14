/* In which order rays ask the faces: all of them, or those in the leaves of the tree that a bundle of rays meets. */

#if ACCEL == ACCEL_NONE

/* One leaf with all faces. */
typedef int Stack;
typedef int Bundle;

INLINE Bundle bundle_from(const Apex *a, const Pencil *pencils, int packets, real spread) { return 0; }
INLINE Bundle bundle_within(const Apex *a, const real *low, const real *high) { return 0; }
INLINE Bundle bundle_of(const Line *l, Mask active) { return 0; }
INLINE void bundle_shorten(Bundle *b, real reach) {}
INLINE void bundle_leave_out_sides(Bundle *b, bool towards) {}
INLINE Stack stack_of(const Tree *tree, const Bundle *b) { return 1; }
INLINE bool misses_all(const Tree *tree, const Bundle *b) { return false; }
INLINE int face_in_leaf(const Tree *tree, int i) { return i; }

INLINE bool next_leaf(const Geometry *g, const Tree *tree, const Bundle *b, uint rays, Stack *stack, int *first, int *count,
                      Counters *c)
{
    *first = 0;
    *count = g->face_count;
    return (*stack)-- > 0;
}

#endif

INLINE bool any_packet(const Mask *masks)
{
    Mask any = masks[0];
    for (int p = 1; p < PACKETS; p++)
        any |= masks[p];
    return ANY(any);
}

/* How many faces a large group of rays may meet before it is cut into smaller ones; tuned on the ladder of scenes. */
enum { NEAREST_BUDGET = 16, BLOCKED_BUDGET = 12 };
#define NO_BUDGET 0xffffffffu
#define NEAR_MOST ((real)0.1f)
#define NEAR_LEAST ((real)3e-3f) /* groups of directions so near are cut no more */
#define NEAR_LESS ((real)0.125f)

/* How far active lanes have to look: to the farthest of their nearest hits. */
INLINE real farthest(const Nearest *n, Mask active)
{
    real lowest = lanes_lowest(active ? n->low : (Lanes)REACH_ALL);
    return lowest > 1 / REACH_ALL ? 1 / lowest : REACH_ALL;
}

/* The nearest faces ahead of the active lanes of the pencils, which come from one apex. False: after more than `budget` faces it
 * gave up; what it has found by then is right but not all. `outside`: as see_face. close: collects the lanes
 * that might need what is left out. */
INLINE bool walk_nearest(const Geometry *g, const Tree *tree, const Apex *a, const Pencil *pencils, const Ray *rays,
                         Nearest *nearest, Bundle b, int packets, uint budget, bool outside, Mask *close, Counters *counters)
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
    if (outside)
        bundle_leave_out_sides(&b, false);
    Stack stack = stack_of(tree, &b);
    for (int first, count; next_leaf(g, tree, &b, lanes, &stack, &first, &count, counters);) {
        asked += (uint)count;
        for (int k = first; k < first + count; k++) {
            int i = face_in_leaf(tree, k);
            ApexFace face;
            Sight sight = see_face(a, g->edges + (size_t)i * FACE_REALS, false, outside, &face);
            if (sight == SIGHT_NONE) {
                if (face.closed)
                    counters->kinds[COUNT_SKIPPED + SKIP_BACK_FACE] += lanes;
                continue;
            }
            real farthest_reach = 0;
            EACH_OF(p, packets) {
                if (reach[p] > 0) {
                    const Pencil *pencil = pencils + p;
                    if (sight == SIGHT_DOUBTFUL)
                        close[p] |= pencil->active;
                    bool nearer = sight == SIGHT_CLEAR
                                      ? ask_nearest_from(g, pencil, rays + p, &face, i, nearest + p, close + p)
                                      : settle_nearest(g, rays + p, pencil->active & IS(pencil->left != (Mask)i), i, nearest + p);
                    if (nearer)
                        reach[p] = farthest(nearest + p, pencil->active);
                    farthest_reach = GREATER(farthest_reach, reach[p]);
                }
            }
            bundle_shorten(&b, farthest_reach);
        }
        if (asked > budget)
            break;
    }
    counters->kinds[COUNT_FACE_TESTS] += lanes * asked;
    return asked <= budget;
}

/* The same, by packets where all together meet too many faces, and then with what was left out for the lanes in which that
 * might matter, which `close` collects. b: the bundle of all. What is active in the pencils does not stay. */
INLINE void find_nearest_from(const Geometry *g, const Tree *tree, const Apex *a, Pencil *pencils, const Ray *rays,
                              Nearest *nearest, Bundle b, bool outside, Mask *close, Counters *counters)
{
    EACH_PACKET(p)
        close[p] = (Mask)0;
    int packets = PACKETS;
    uint budget = PACKETS > 1 ? NEAREST_BUDGET : NO_BUDGET;
    __attribute__((opencl_unroll_hint(1))) for (int p = 0; p < PACKETS; p += packets) {
        if (packets < PACKETS)
            b = bundle_from(a, pencils + p, 1, 0);
        if (!walk_nearest(g, tree, a, pencils + p, rays + p, nearest + p, b, packets, budget, outside, close + p, counters)) {
            p = -1;
            packets = 1;
            budget = NO_BUDGET;
        } else if (outside && p + packets == PACKETS && any_packet(close)) {
            outside = false;
            EACH_PACKET(k)
                pencils[k].active = close[k];
            p = -packets;
        }
    }
}

/* The active lanes whose direction is as like that of the first active one as `near` says, pencil by pencil. */
INLINE void like_first(const Pencil *pencils, const Mask *rest, real near, Mask *like)
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

/* blocked: collects the active lanes of the pencils whose segments from the point to the target, an apex, a face blocks, strictly
 * between the two; they are active no more. False: after more than `budget` faces it gave up. */
INLINE bool walk_blocked(const Geometry *g, const Tree *tree, const Apex *a, const wide *target, Pencil *pencils,
                         Points *points, Mask *blocked, uint budget, bool outside, Counters *counters)
{
    uint asking[PACKETS], lanes = 0, asked = 0;
    Lanes ends = (Lanes)REACH_ALL, doubts = (Lanes)1;
    EACH_PACKET(p) {
        const Pencil *pencil = pencils + p;
        lanes += asking[p] = mask_count(pencil->active);
        ends = (pencil->active & IS(pencil->per_end < ends)) ? pencil->per_end : ends;
        doubts = (pencil->active & IS(pencil->doubt > doubts)) ? pencil->doubt : doubts;
    }
    real share = SHARE_OF(-lanes_lowest(-doubts));
    Bundle b = bundle_from(a, pencils, PACKETS, share);
    bundle_shorten(&b, (1 + 2 * share) / lanes_lowest(ends));
    if (outside)
        bundle_leave_out_sides(&b, true);
    Stack stack = stack_of(tree, &b);
    for (int first, count; asked <= budget && next_leaf(g, tree, &b, lanes, &stack, &first, &count, counters);) {
        asked += (uint)count;
        for (int k = first; k < first + count; k++) {
            int i = face_in_leaf(tree, k);
            counters->kinds[COUNT_FACE_TESTS] += lanes;
            ApexFace face;
            Sight sight = see_face(a, g->edges + (size_t)i * FACE_REALS, true, outside, &face);
            if (sight == SIGHT_NONE) {
                if (face.closed)
                    counters->kinds[COUNT_SKIPPED + SKIP_BACK_FACE] += lanes;
                continue;
            }
            EACH_PACKET(p) {
                if (asking[p] == 0)
                    continue;
                Pencil *pencil = pencils + p;
                Mask hit = (Mask)0, doubt = pencil->active & IS(pencil->left != (Mask)i);
                if (sight == SIGHT_CLEAR)
                    hit = ask_blocked_from(pencil, &face, i, &doubt);
                if (ANY(doubt))
                    hit |= ask_blocked(g, shifted_point(points, p), target, doubt, i);
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

/* The same for the lanes of `rest`, in groups of like directions: the more faces a group meets, the smaller the next ones.
 * Those that are `close` come last, and all faces are asked for them. */
NOINLINE void find_blocked(const Geometry *g, const Tree *tree, const wide *target, Pencil *pencils, Points *points,
                         const Mask *close, Mask *rest, Mask *blocked, Counters *counters)
{
    Mask later[PACKETS];
    Apex a = apex_at(target, 0, 1 + 4 * REAL_ROUNDING);
    real near = NEAR_MOST;
    bool outside = true;
    EACH_PACKET(p) {
        blocked[p] = (Mask)0;
        later[p] = rest[p] & close[p];
        rest[p] &= ~close[p];
    }
    for (;;) {
        if (!any_packet(rest)) {
            if (!outside || !any_packet(later))
                return;
            outside = false;
            near = NEAR_MOST;
            EACH_PACKET(p)
                rest[p] = later[p];
        }
        Mask group[PACKETS];
        like_first(pencils, rest, near, group);
        EACH_PACKET(p) {
            rest[p] &= ~group[p];
            pencils[p].active = group[p];
        }
        bool last = near < NEAR_LEAST;
        if (!walk_blocked(g, tree, &a, target, pencils, points, blocked, last ? NO_BUDGET : BLOCKED_BUDGET, outside, counters)) {
            near *= NEAR_LESS;
            EACH_PACKET(p)
                rest[p] |= pencils[p].active;
        }
    }
}

/* The nearest faces ahead of one packet of any rays, exactly. */
static Hit find_nearest_apart(const Geometry *g, const Tree *tree, const Ray *ray, Mask active, Counters *counters)
{
    Line l = line(vec_to_real(ray->origin), vec_to_real(ray->direction));
    Hit nearest = no_hit();
    uint lanes = mask_count(active);
    Bundle b = bundle_of(&l, active);
    Stack stack = stack_of(tree, &b);
    for (int first, count; next_leaf(g, tree, &b, lanes, &stack, &first, &count, counters);) {
        bool nearer = false;
        for (int k = first; k < first + count; k++)
            nearer |= ask_nearest(g, &l, ray, active, face_in_leaf(tree, k), &nearest);
        counters->kinds[COUNT_FACE_TESTS] += lanes * (uint)count;
        if (nearer) {
            Lanes t = TO_REAL(nearest.t_in_box < (Wide)REACH_ALL ? nearest.t_in_box : (Wide)REACH_ALL) * l.scale;
            bundle_shorten(&b, -lanes_lowest(active ? -t : (Lanes)0));
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
static Hit find_nearest_of_pencil(const Geometry *g, const Tree *tree, const Ray *ray, Mask active, Counters *counters)
{
    Pencil pencils[PACKETS];
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
    find_nearest_from(g, tree, &a, pencils, rays, nearest, bundle_from(&a, pencils, PACKETS, 0), false, close, counters);
    return exact_hit(g, ray, nearest, active);
}
