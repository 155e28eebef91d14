/* The one loop over facets. It serves a window that is only classified, a tile of packets, and a single packet.
 *
 *     for each bounce
 *         find the facet and its lights, unless they are known
 *         each packet: total += weight * what it sees of the facet
 *         the facet is the last one, or no ray has light enough to go on:  done
 *         weight *= what the facet reflects
 *
 * All packets see a facet before any goes on to the next. The search of its shadows needs them together. */
#include "shared/compiler.cl"
#include "shared/layout.h"
#include "packet/camera.cl"
#include "packet/lanes.cl"
#include "packet/light.cl"
#include "packet/paths.cl"
#include "packet/vectors.cl"
#include "packet/world.cl"
#include "tile/classify.cl"
#include "tile/facet.cl"
#include "tile/mirror_chain.cl"

/* Packets of a tile on their way. */
typedef struct Packets {
    const ScreenPlaces *places; /* of the tile */
    int first, count;           /* `count` of its packets, from that one on */
    Path *paths;                /* theirs */
} Packets;

/* The packet's paths go on from the facet with what it reflects. Returns how many of them do. */
INLINE uint leave_facet(const World *world, const Facet *f, Mask lit, Path *path)
{
    if (!world->parameters->shadow_ambient)
        path->active &= lit;
    drop_weak(world, path, (Lanes)f->reflection);
    path->weight = path->weight * f->reflection;
    return mask_count(path->active);
}

/* Adds what each packet sees of the facet to its sum. False: an approximate point is too far off. */
INLINE bool see_facet(const World *world, const Facet *f, const Packets *packets, Illumination *sums)
{
    EACH_OF(i, packets->count)
        if (!shade_facet(world, f, packets->places, packets->first + i, packets->paths[i].active, sums + i))
            return false;
    return true;
}

/* The same with all lights, which the chain puts on the facet as many at a time as there is room for. */
INLINE bool see_lit_facet(const World *world, MirrorChain *chain, Facet *f, const Packets *packets, Illumination *sums)
{
    do {
        if (!light_facet(world, chain, f) || !see_facet(world, f, packets, sums))
            return false;
    } while (chain->tile && f->next_light < world->parameters->light_count);
    return true;
}

/* Follows the packets from facet to facet. True: to the end, or until no ray is left.
 *
 * chain: finds the facets. A block keeps them all in `facets`; a tile uses the first one again and again. NULL: they
 * are there. rays: counts the rays, bounce by bounce; NULL: they are counted at once. False: from there on the rays may
 * hit different faces, or an approximate point is too far off. */
INLINE bool follow_facets(const World *world, MirrorChain *chain, Facet *facets, const Packets *packets, uint *rays)
{
    Vec background = vec_row(world->view + VIEW_BACKGROUND);
    uint active = chain ? chain->rays : 0;
    for (int bounce = 0;; bounce++) {
        Facet *f = chain && chain->tile ? facets : facets + bounce;
        if (chain) {
            chain->rays = active;
            if (!find_facet(world, chain, f))
                return false;
        }
        Illumination sums[PACKETS];
        EACH_OF(i, packets->count) {
            sums[i].colour = f->face < 0 ? background : vec(0, 0, 0);
            sums[i].lit = (Mask)0;
        }
        if (f->face >= 0 &&
            !(chain ? see_lit_facet(world, chain, f, packets, sums) : see_facet(world, f, packets, sums))) {
            if (chain)
                forget_facet(world, chain);
            return false;
        }
        if (chain && chain->tile)
            count_facet(world, f, active);
        if (packets->count > 0)
            active = 0;
        EACH_OF(i, packets->count) {
            Path *path = packets->paths + i;
            if (rays)
                rays[bounce] += mask_count(path->active);
            path_add(path, path->active, sums[i].colour);
            if (!f->last)
                active += leave_facet(world, f, sums[i].lit, path);
        }
        if (f->last || (active == 0 && packets->count > 0))
            return true;
        if (chain) {
            if (chain->tile)
                world->counters[COUNT_REFLECTION] += active;
            chain->camera = camera_in_mirror(world, f->face, &chain->camera);
        }
    }
}
