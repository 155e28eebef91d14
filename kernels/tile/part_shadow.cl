/* The shadow of a light that reaches a part of a facet: ray by ray, among the faces that the window's corners have not
 * ruled out.
 *
 *     each packet: its shadow rays, along the reversed ray from the light to the approximate points
 *     all packets: find_blocked, beginning where the search of the corners ended
 *
 * It costs the exact rays of the tile, from which a point is made where a ray passes an edge too closely. It buys that
 * a partly shadowed facet stays uniform; its gain is part of whole_tile. docs/kernels.md, section 12. */
#include "shared/compiler.cl"
#include "shared/precision.cl"
#include "packet/apex.cl"
#include "packet/approx.cl"
#include "packet/intersect.cl"
#include "packet/lanes.cl"
#include "packet/paths.cl"
#include "packet/points.cl"
#include "packet/rays.cl"
#include "packet/shadow.cl"
#include "packet/tree.cl"
#include "packet/vectors.cl"
#include "packet/world.cl"
#include "tile/facet.cl"
#include "tile/mirror_chain.cl"

/* Finds the lanes that a light does not reach. stack: leads to what may block them. False: an approximate point is too
 * far off. */
NOINLINE bool find_part_shadow(const World *world, const MirrorChain *chain, const Facet *f, const wide *position,
                               const Stack *stack, Mask *blocked)
{
    int bounces = chain->found->bounces - 1; /* before the facet */
    Path paths[PACKETS];
    Ray rays[PACKETS];
    Nearest nearest[PACKETS];
    Mask all[PACKETS], near_ties[PACKETS], wanted[PACKETS];
    OriginPacket packets[PACKETS];
    Vec light = from_apexes(position, f->camera.eye, 0);
    EACH_PACKET(p) {
        Vec ahead, l;
        Lanes share;
        ApproxPoint approx = approx_on_facet(f, chain->tile->places, p, &ahead);
        wanted[p] = chain->tile->paths[p].active;
        if (!approx_towards(&approx, light, wanted[p], &l, &packets[p].per_end, &share))
            return false;
        packets[p].ahead = vec_minus(l);
        packets[p].slack = SLACK_OF(share);
        packets[p].active = (Mask)0;
        packets[p].from = (Mask)f->face;
        all[p] = (Mask)-1;
        near_ties[p] = (Mask)(bounces > 0 ? -1 : 0);
        nearest[p].face = (Mask)f->face;
        nearest[p].from_behind = (Mask)(f->sign < 0 ? -1 : 0);
    }
    rays_after_mirrors(world, chain, bounces, paths, rays);
    LazyPoints points;
    begin_points(world, &points, rays, nearest, all, bounces == 0);
    ShadowGroup group = {position, packets, &points, blocked};
    find_blocked(world, &group, wanted, near_ties, stack);
    return true;
}
