/* The nearest faces of one packet of rays from a list.
 *
 *     all rays start at one point:  search like the rays of a tile, nearest.cl
 *     otherwise:
 *         for each leaf that the bounds of the rays meet:
 *             test each of its faces exactly;  a nearer hit shortens the bounds
 *
 * Rays without a common origin cost a sum for each edge, face and ray that others share. `cast` alone needs them. */
#include "shared/layout.h"
#include "shared/precision.cl"
#include "packet/accel.cl"
#include "packet/apex.cl"
#include "packet/intersect.cl"
#include "packet/intersect_exactly.cl"
#include "packet/lanes.cl"
#include "packet/nearest.cl"
#include "packet/rays.cl"
#include "packet/tree.cl"
#include "packet/vectors.cl"
#include "packet/world.cl"

/* The nearest faces of rays that start anywhere. */
static Hit find_nearest_of_any_rays(const World *world, const Ray *ray, Mask active)
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

/* The lanes whose ray starts where that of the first lane does. */
static Mask same_origin(const Ray *ray)
{
    WideVec o = ray->origin;
    wide first[3] = {first_wide(o.x), first_wide(o.y), first_wide(o.z)};
    return TO_MASK(IS(o.x == (Wide)first[0]) & IS(o.y == (Wide)first[1]) & IS(o.z == (Wide)first[2]));
}

/* The nearest faces of rays that all start at one point. */
static Hit find_nearest_from_point(const World *world, const Ray *ray, Mask active)
{
    OriginPacket packets[PACKETS];
    Nearest nearest[PACKETS];
    Ray rays[PACKETS];
    Mask near_ties[PACKETS];
    Vec direction = vec_to_real(ray->direction);
    EACH_PACKET(p) {
        rays[p] = *ray;
        packets[p].ahead = direction;
        packets[p].active = p == 0 ? active : (Mask)0;
        packets[p].from = (Mask)-1;
        nearest[p] = nothing_yet();
    }
    wide origin[3] = {first_wide(ray->origin.x), first_wide(ray->origin.y), first_wide(ray->origin.z)};
    Apex a = apex_at(origin, 0, -lanes_lowest(active ? -vec_magnitudes(direction) : (Lanes)0));
    RayBounds bounds = bounds_from(&a, packets, PACKETS, 0);
    Group group = {PACKETS, packets, rays, nearest, near_ties};
    find_nearest_from(world, &a, &group, &bounds, 0, false);
    return exact_hit(world, ray, nearest, active);
}
