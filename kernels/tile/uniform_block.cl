/* Uniform blocks: each pixel of a block, or of its quarter, sees the same faces and the same lights on every bounce.
 * Its packets are shaded one by one, to their last bounce, without any search. A packet stays in registers. Its facets
 * are made once for all tiles of the block.
 *
 *     for each packet of a tile, for each sample of a pixel
 *         follow the packet from facet to facet
 *
 * It buys a fifth to a third of the time in rooms (docs/experiments.md), and comes to the same as uniform_tile.cl, bit
 * by bit. */
#include "shared/compiler.cl"
#include "shared/layout.h"
#include "shared/skips.h"
#include "packet/camera.cl"
#include "packet/lanes.cl"
#include "packet/paths.cl"
#include "packet/picture.cl"
#include "packet/tiles.cl"
#include "packet/vectors.cl"
#include "packet/window.cl"
#include "packet/world.cl"
#include "tile/classify.cl"
#include "tile/facet.cl"
#include "tile/follow.cl"
#include "tile/mirror_chain.cl"

typedef struct UniformBlock {
    Facet facets[CLASSIFIED_BOUNCES];
} UniformBlock;

/* Classifies a window of so many rays. parent: of the window around it, or NULL. True: it is uniform, and the block is
 * made. */
NOINLINE bool classify_window(const World *world, const Window *window, uint rays, const Classification *parent,
                              Classification *found, UniformBlock *block)
{
    MirrorChain chain = begin_chain(world, window, rays, parent, found);
    Packets none = {0, 0, 0, 0};
    return follow_facets(world, &chain, block->facets, &none, 0) && chain.decided;
}

/* Renders a tile of a uniform block; rgb: as render_tile. False: an approximate point is too far off, and nothing is
 * done. */
NOINLINE bool render_uniform_tile(const World *world, UniformBlock *block, int first_column, int first_row,
                                  global uchar *rgb)
{
    constant const Parameters *p = world->parameters;
    uint rays[CLASSIFIED_BOUNCES] = {0}, weak = world->counters[COUNT_SKIPPED + SKIP_WEAK_BOUNCE];
    Vec sum[PACKETS];
    EACH_PACKET(k)
        sum[k] = vec(0, 0, 0);
    for (int j = 0; j < p->grid; j++)
        for (int i = 0; i < p->grid; i++) {
            ScreenPlaces places = screen_places(world, first_column, first_row, i, j);
            EACH_PACKET(k) {
                Path path;
                path.active = pixels_inside(p, first_column, first_row, k);
                path.total = vec(0, 0, 0);
                path.weight = (Lanes)1;
                if (!ANY(path.active))
                    continue;
                Packets packet = {&places, k, 1, &path};
                if (!follow_facets(world, 0, block->facets, &packet, rays)) {
                    world->counters[COUNT_SKIPPED + SKIP_WEAK_BOUNCE] = weak;
                    return false;
                }
                sum[k] = vec_add(sum[k], path.total);
            }
        }
    store_tile(p, first_column, first_row, sum, rgb);
    world->counters[COUNT_PRIMARY] += rays[0];
    for (int bounce = 0; bounce < CLASSIFIED_BOUNCES && rays[bounce] > 0; bounce++) {
        world->counters[COUNT_REFLECTION] += bounce > 0 ? rays[bounce] : 0;
        count_facet(world, block->facets + bounce, rays[bounce]);
    }
    return true;
}
