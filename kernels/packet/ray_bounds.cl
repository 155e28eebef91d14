/* Bundles of rays, for the trees: what bounds all of them on each axis, and where they may be between two planes.
 * A bundle visits a box when the intervals of its origins and directions allow some ray of it to meet the box
 * (interval traversal: Boulos, Wald, Benthin, "Adaptive Ray Packet Reordering", 2008, section 3). */
#include "shared/compiler.cl"
#include "shared/layout.h"
#include "shared/precision.cl"
#include "packet/accel.cl"
#include "packet/apex.cl"
#include "packet/lanes.cl"
#include "packet/rays.cl"
#include "packet/vectors.cl"

/* What bounds all rays of a bundle on one axis, the directions scaled to a largest component of 1. */
typedef struct Slab {
    real origin_low, origin_high;
    real inverse_low, inverse_high; /* 1 / the lowest and the highest direction */
    int sign;                       /* of all directions; 0: they differ */
} Slab;

typedef struct RayBounds {
    Slab slabs[3];
    real reach; /* no ray of the bundle goes farther than this */
    int culled_sides[3]; /* for each axis: the SIDE_KEY of the sides of closed boxes that need not be asked */
} RayBounds;

#define GROWN(x) ((x) * (1 + 32 * REAL_ROUNDING)) /* more than the rounding of what follows could take away */

INLINE real lowest(Lanes x, Mask active) { return lanes_lowest(active ? x : (Lanes)REACH_ALL); }
INLINE real highest(Lanes x, Mask active) { return -lowest(-x, active); }

/* From the lowest and highest origin and direction. */
INLINE Slab slab(real origin_low, real origin_high, real low, real high)
{
    Slab s;
    /* They have been rounded to real. */
    s.origin_low = origin_low - 2 * REAL_ROUNDING * fabs(origin_low);
    s.origin_high = origin_high + 2 * REAL_ROUNDING * fabs(origin_high);
    s.sign = low > 0 ? 1 : high < 0 ? -1 : 0;
    /* Directions that differ in sign, or are 0: those below 0 come from the high plane, those above from the low one. */
    s.inverse_low = s.sign != 0 || low < 0 ? 1 / low : -(real)INFINITY;
    s.inverse_high = s.sign != 0 || high > 0 ? 1 / high : (real)INFINITY;
    return s;
}

INLINE void bounds_keep_sides(RayBounds *b)
{
    for (int axis = 0; axis < 3; axis++)
        b->culled_sides[axis] = NO_SIDE_KEY;
}

/* Leaves out the sides of closed boxes that all rays, outside of them, meet after another side: what is a back to all of them.
 * `towards`, as setup_face: the rays travel against the bundle, and of what they meet the first side is left out, not the last.
 * The signs of the bundle's directions are those of the rays themselves, to the last digit. */
INLINE void bounds_cull_sides(RayBounds *b, bool reversed)
{
    for (int axis = 0; axis < 3; axis++) {
        int sign = b->slabs[axis].sign;
        if (sign != 0)
            b->culled_sides[axis] = SIDE_KEY(2 * axis + ((sign > 0) != reversed));
    }
}

/* Rays from an apex whose directions are between two, axis by axis. */
INLINE RayBounds bounds_within(const Apex *a, const real *low, const real *high)
{
    real at[3] = {a->x, a->y, a->z};
    RayBounds b;
    for (int axis = 0; axis < 3; axis++)
        b.slabs[axis] = slab(at[axis] - a->spread, at[axis] + a->spread, low[axis], high[axis]);
    b.reach = REACH_ALL;
    bounds_keep_sides(&b);
    return b;
}

/* Rays from an apex. spread: no component of an exact direction is farther from the packets'. */
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

/* Any rays of one packet. */
INLINE RayBounds bounds_of(const RealRay *l, Mask active)
{
    RayBounds b;
    b.slabs[0] = slab(lowest(l->origin.x, active), highest(l->origin.x, active), lowest(l->scaled.x, active), highest(l->scaled.x, active));
    b.slabs[1] = slab(lowest(l->origin.y, active), highest(l->origin.y, active), lowest(l->scaled.y, active), highest(l->scaled.y, active));
    b.slabs[2] = slab(lowest(l->origin.z, active), highest(l->origin.z, active), lowest(l->scaled.z, active), highest(l->scaled.z, active));
    b.reach = REACH_ALL;
    bounds_keep_sides(&b);
    return b;
}

INLINE void bounds_shorten(RayBounds *b, real reach) { b->reach = reach < REACH_ALL ? GROWN(reach) : REACH_ALL; }

/* Narrows [enter, leave] to where the bundle may be between the two planes. 0 * infinity, which is NaN, narrows nothing. */
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
