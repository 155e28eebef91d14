/* Bounds of a bundle of rays, for the trees (interval traversal: Boulos, Wald, Benthin, "Adaptive Ray Packet
 * Reordering", 2008, section 3).
 *
 *     on each axis: the interval of the origins, and that of the directions
 *     the bundle visits a box if some ray within these intervals may meet it
 *
 * One test serves all rays of a tile. The wider the bundle, the more boxes it visits in vain. docs/kernels.md, section
 * 6. */
#include "shared/compiler.cl"
#include "shared/layout.h"
#include "shared/precision.cl"
#include "packet/accel.cl"
#include "packet/apex.cl"
#include "packet/lanes.cl"
#include "packet/rays.cl"
#include "packet/vectors.cl"

/* The bounds on one axis. Directions are scaled to a largest component of 1, except those of rays from an apex. */
typedef struct Slab {
    real origin_low, origin_high;
    real inverse_low, inverse_high; /* 1 / the lowest and the highest direction */
    int sign;                       /* of all directions; 0: they have several */
} Slab;

typedef struct RayBounds {
    Slab slabs[3];
    real reach;          /* no ray goes farther than this t */
    int culled_sides[3]; /* for each axis: the SIDE_KEY of the sides of closed boxes that are culled */
} RayBounds;

/* Larger by more than what the rounding of a few operations can take away. */
#define GROWN(x) ((x) * (1 + 32 * REAL_ROUNDING))

/* The lowest and the highest value of the active lanes. */
INLINE real lowest(Lanes x, Mask active) { return lanes_lowest(active ? x : (Lanes)REACH_ALL); }
INLINE real highest(Lanes x, Mask active) { return -lowest(-x, active); }

/* The bounds of rays between the lowest and the highest origin, and between the lowest and the highest direction. */
INLINE Slab slab(real origin_low, real origin_high, real low, real high)
{
    Slab s;
    /* The origins have been rounded to real. */
    s.origin_low = origin_low - 2 * REAL_ROUNDING * fabs(origin_low);
    s.origin_high = origin_high + 2 * REAL_ROUNDING * fabs(origin_high);
    s.sign = low > 0 ? 1 : high < 0 ? -1 : 0;
    /* Where the signs differ, directions below 0 come from the high plane, and those above 0 from the low one. */
    s.inverse_low = s.sign != 0 || low < 0 ? 1 / low : -(real)INFINITY;
    s.inverse_high = s.sign != 0 || high > 0 ? 1 / high : (real)INFINITY;
    return s;
}

INLINE void bounds_keep_sides(RayBounds *b)
{
    for (int axis = 0; axis < 3; axis++)
        b->culled_sides[axis] = NO_SIDE_KEY;
}

/* Culls the sides of closed boxes that all rays meet from behind: rays from outside the box meet another side first.
 * reversed: the rays travel against the bundle, as for setup_face. The first side that they meet is culled then, not
 * the last. This is exact: rounding does not change the sign of a direction. */
INLINE void bounds_cull_sides(RayBounds *b, bool reversed)
{
    for (int axis = 0; axis < 3; axis++) {
        int sign = b->slabs[axis].sign;
        if (sign != 0)
            b->culled_sides[axis] = SIDE_KEY(2 * axis + ((sign > 0) != reversed));
    }
}

/* Bounds of rays from an apex whose directions lie between two, axis by axis. */
COMPILED_ONCE RayBounds bounds_within(const Apex *a, const real *low, const real *high)
{
    real at[3] = {a->x, a->y, a->z};
    RayBounds b;
    for (int axis = 0; axis < 3; axis++)
        b.slabs[axis] = slab(at[axis] - a->spread, at[axis] + a->spread, low[axis], high[axis]);
    b.reach = REACH_ALL;
    bounds_keep_sides(&b);
    return b;
}

/* Bounds of the packets' active rays from an apex. spread: the largest error of a component of a direction. */
INLINE RayBounds bounds_from(const Apex *a, const OriginPacket *packets, int packet_count, real spread)
{
    Lanes all = (Lanes)REACH_ALL, low[3] = {all, all, all}, high[3] = {-all, -all, -all};
    EACH_OF(p, packet_count) {
        Mask active = packets[p].active;
        Vec d = packets[p].ahead;
        Lanes xyz[3] = {d.x, d.y, d.z};
        for (int axis = 0; axis < 3; axis++) {
            low[axis] = (active & IS(xyz[axis] < low[axis])) ? xyz[axis] : low[axis];
            high[axis] = (active & IS(xyz[axis] > high[axis])) ? xyz[axis] : high[axis];
        }
    }
    real lowest_of[3], highest_of[3];
    for (int axis = 0; axis < 3; axis++) {
        lowest_of[axis] = lanes_lowest(low[axis]) - spread;
        highest_of[axis] = -lanes_lowest(-high[axis]) + spread;
    }
    return bounds_within(a, lowest_of, highest_of);
}

/* Bounds of one packet of any rays. */
INLINE RayBounds bounds_of(const RealRay *l, Mask active)
{
    RayBounds b;
    Lanes o[3] = {l->origin.x, l->origin.y, l->origin.z}, d[3] = {l->scaled.x, l->scaled.y, l->scaled.z};
    for (int i = 0; i < 3; i++)
        b.slabs[i] = slab(lowest(o[i], active), highest(o[i], active), lowest(d[i], active), highest(d[i], active));
    b.reach = REACH_ALL;
    bounds_keep_sides(&b);
    return b;
}

/* Shortens the rays to `reach`, since none has to look for a farther hit. */
INLINE void bounds_shorten(RayBounds *b, real reach) { b->reach = reach < REACH_ALL ? GROWN(reach) : REACH_ALL; }

/* Narrows [enter, leave] to where the bundle may be between two planes, for the planes of LANES boxes at once. NaN,
 * which is 0 * infinity, narrows nothing. */
INLINE void cross_slab(Slab s, Lanes low, Lanes high, Lanes *enter, Lanes *leave)
{
    low -= s.origin_high;
    high -= s.origin_low;
    Lanes near, far = (Lanes)REACH_ALL;
    if (s.sign > 0) {
        near = LESSER(low * s.inverse_low, low * s.inverse_high);
        far = GREATER(high * s.inverse_low, high * s.inverse_high);
    } else if (s.sign < 0) {
        near = LESSER(high * s.inverse_low, high * s.inverse_high);
        far = GREATER(low * s.inverse_low, low * s.inverse_high);
    } else {
        near = GREATER(low * s.inverse_high, high * s.inverse_low);
    }
    *enter = near > *enter ? near : *enter;
    *leave = far < *leave ? far : *leave;
}
