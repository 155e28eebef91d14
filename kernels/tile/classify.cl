/* Classification. A window of the screen is a block of tiles, its quarter, or a tile. Where one face covers the window,
 * and mirrors another face that covers it, and so on, all its rays hit the same faces. Mostly they see the same lights,
 * too.
 *
 *     the next hit: the window around it has found it, or
 *                   find_covering_face among what that window has not ruled out
 *     each light:   the window around it has classified it, or
 *                   classify_shadow
 *
 * A planar mirror shows what its image of the camera sees. So each hit is found as the first one is.
 *
 * It costs some four rays for a window. It buys that no ray of the window is searched by itself: rooms take a quarter
 * to a third of the time (docs/performance.md, `whole_tile`), cities of many small faces as much as without it. */
#include "shared/compiler.cl"
#include "shared/layout.h"
#include "shared/precision.cl"
#include "shared/skips.h"
#include "packet/apex.cl"
#include "packet/lanes.cl"
#include "packet/light.cl"
#include "packet/planes.cl"
#include "packet/tree.cl"
#include "packet/window.cl"
#include "packet/world.cl"
#include "tile/covering_face.cl"
#include "tile/facet.cl"
#include "tile/frustum.cl"
#include "tile/mirror_chain.cl"
#include "tile/part_shadow.cl"
#include "tile/shadow_class.cl"

enum { CLASSIFIED_BOUNCES = 16 }; /* a block is classified so far; a tile goes on as far as its rays do */

/* Finds the next hit, and makes it a facet without lights. False: the rays may hit different faces. */
NOINLINE bool find_facet(const World *world, MirrorChain *chain, Facet *f)
{
    const Classification *parent = chain->parent;
    Classification *found = chain->found;
    int bounce = found->bounces;
    UniformHit *hit = found->hits + bounce;
    chain->corners = camera_frustum(&chain->camera, chain->window);
    chain->backs = world->counters[COUNT_SKIPPED + SKIP_BACK_FACE];
    if (parent && bounce < parent->bounces) {
        *hit = parent->hits[bounce];
    } else {
        int from = bounce > 0 ? hit[-1].seen.face : -1;
        Apex a = apex_of_image(world, &chain->camera, &chain->corners, bounce);
        found->resume =
            parent && bounce == parent->bounces ? parent->resume : begin_in_frustum(world, &a, &chain->corners);
        bool is_full = !chain->tile && bounce == CLASSIFIED_BOUNCES;
        if (is_full || !MAY_SKIP(world->parameters, SKIP_WHOLE_TILE) ||
            !find_covering_face(world, &a, &chain->corners, from, chain->rays, &hit->seen, &found->resume))
            return false;
        hit->lit = hit->shadowed = 0;
    }
    found->bounces = bounce + 1;
    make_facet(world, hit->seen, &chain->camera, bounce, f);
    return true;
}

/* Makes as if the last hit had not been found. The tests that were done stay counted. */
INLINE void forget_facet(const World *world, MirrorChain *chain)
{
    Classification *found = chain->found;
    found->bounces--;
    Apex a = apex_of_image(world, &chain->camera, &chain->corners, found->bounces);
    found->resume = begin_in_frustum(world, &a, &chain->corners); /* the search had succeeded, and used it up */
    world->counters[COUNT_SKIPPED + SKIP_BACK_FACE] = chain->backs;
}

/* Is the side of the facet that is seen turned to the light? As turned_to_light. */
INLINE bool faces_the_light(const World *world, const Facet *f, const wide *light)
{
    wide side = plane_distance_of_point(world, f->face, light);
    return f->sign < 0 ? side < 0 : side > 0;
}

/* How much of a facet lies in the shadow of light i. PARTLY_SHADOWED: what may block the light is on the stack. */
INLINE ShadowClass classify_light(const World *world, const MirrorChain *chain, const Patch *patch, int i,
                                  const wide *position, Stack *stack)
{
    int bounce = chain->found->bounces - 1;
    UniformHit *hit = chain->found->hits + bounce;
    uint bit = i < FACET_LIGHTS ? 1u << i : 0;
    if (hit->lit & bit)
        return LIT;
    if (hit->shadowed & bit)
        return SHADOWED;
    ShadowClass shadow = classify_shadow(world, patch, position, bounce == 0, chain->rays, stack);
    hit->lit |= shadow == LIT ? bit : 0;
    hit->shadowed |= shadow == SHADOWED ? bit : 0;
    return shadow;
}

/* Adds light i to a facet. Of a block it is undecided where only some rays see the light; of a tile these are found.
 * False: an approximate point is too far off. */
INLINE bool light_facet_by(const World *world, MirrorChain *chain, const Patch *patch, int i, Facet *f)
{
    global const real *light = world->lights + i * LIGHT_REALS;
    wide position[3];
    light_position(light, position);
    bool facing = faces_the_light(world, f, position);
    ShadowClass shadow = SHADOWED;
    Mask *blocked = 0;
    if (wants_shadow_rays(world, light, facing)) {
        Stack stack;
        uint backs = world->counters[COUNT_SKIPPED + SKIP_BACK_FACE];
        shadow = facing || chain->tile ? classify_light(world, chain, patch, i, position, &stack) : PARTLY_SHADOWED;
        if (shadow == PARTLY_SHADOWED && !chain->tile) {
            world->counters[COUNT_SKIPPED + SKIP_BACK_FACE] = backs; /* the parts of the window count them again */
            chain->decided &= chain->dark;
            return true;
        }
        if (shadow == PARTLY_SHADOWED) {
            blocked = chain->tile->blocked[f->light_count];
            if (!find_part_shadow(world, chain, f, position, &stack, blocked))
                return false;
        }
    }
    add_light(world, light, facing, shadow, blocked, f);
    return true;
}

/* Counts the rays of PARTLY_SHADOWED lights that make no highlight. */
INLINE void count_dull_rays(const TileRays *tile, Facet *f)
{
    for (int i = 0; i < f->light_count; i++) {
        const FacetLight *light = f->lights + i;
        if (light->blocked && !light->terms.has_highlight)
            EACH_PACKET(p)
                f->dull_rays += mask_count(tile->paths[p].active & ~light->blocked[p]);
    }
}

/* Puts the next lights on a facet, as many as it has room for. False: an approximate point is too far off. */
NOINLINE bool light_facet(const World *world, MirrorChain *chain, Facet *f)
{
    int lights = world->parameters->light_count, end = min(lights, f->next_light + FACET_LIGHTS);
    Patch patch = patch_of(world, f->face, &chain->camera, &chain->corners, f->height, f->off);
    f->light_count = 0;
    for (; f->next_light < end; f->next_light++)
        if (!light_facet_by(world, chain, &patch, f->next_light, f))
            return false;
    if (chain->tile)
        count_dull_rays(chain->tile, f);
    else {
        chain->decided &= chain->dark || end == lights;
        chain->dark |= !world->parameters->shadow_ambient && chain->found->hits[chain->found->bounces - 1].lit == 0;
    }
    return true;
}
