/* Tiles of blocks that are not uniform. A tile goes on from what its block has found.
 *
 *     follow_facets: classify and shade hit by hit, as far as all rays hit the same face
 *     the rays may hit different faces: make the exact rays, and packet/trace.cl goes on with them
 *
 * It costs the search of four corner rays, in vain where the tile is mixed at once. It buys one search for 64 rays:
 * cornell 50.1 to 11.6 ms with whole tiles. In large scenes it is a loss of up to 7 %. docs/kernels.md, section 11. */
#include "shared/compiler.cl"
#include "packet/camera.cl"
#include "packet/lanes.cl"
#include "packet/paths.cl"
#include "packet/rays.cl"
#include "packet/vectors.cl"
#include "packet/window.cl"
#include "packet/world.cl"
#include "tile/facet.cl"
#include "tile/follow.cl"
#include "tile/mirror_chain.cl"

/* Traces the active paths of a tile as far as all of them hit the same faces. True: to the end. False: paths and rays
 * have been mirrored so many times as found->bounces says, and found->resume is what is left of their next search. */
NOINLINE bool trace_uniform_tile(const World *world, const ScreenPlaces *places, const Window *window,
                                 const Classification *parent, Path *paths, Ray *rays, Classification *found)
{
    uint active = 0;
    EACH_PACKET(p) {
        paths[p].total = vec(0, 0, 0);
        paths[p].weight = (Lanes)1;
        active += mask_count(paths[p].active);
    }
    Facet facet;
    Mask blocked[FACET_LIGHTS][PACKETS];
    TileRays tile = {places, paths, blocked};
    MirrorChain chain = begin_chain(world, window, active, parent, found);
    chain.tile = &tile;
    Packets packets = {places, 0, PACKETS, paths};
    if (follow_facets(world, &chain, &facet, &packets, 0))
        return true;
    rays_after_mirrors(world, &chain, found->bounces, paths, rays);
    return false;
}
