/* Blocks whose corners have told all, to the last bounce and light: each packet of theirs goes its whole way by itself, in
 * registers. It comes to what whole_tile.cl would, to the last bit. docs/algorithm.md, section 11. */
#include "shared/compiler.cl"
#include "shared/layout.h"
#include "shared/precision.cl"
#include "shared/skips.h"
#include "packet/camera.cl"
#include "packet/lanes.cl"
#include "packet/paths.cl"
#include "packet/picture.cl"
#include "packet/vectors.cl"
#include "packet/world.cl"
#include "tile/classify.cl"
#include "tile/facet.cl"
#include "tile/frustum.cl"

#if !CLASSIFIES_TILES

typedef int UniformBlock;

INLINE bool make_uniform_block(const World *world, const Classification *o, UniformBlock *told) { return false; }
INLINE bool render_uniform_tile(const World *world, const UniformBlock *told, int column, int row, global uchar *rgb)
{
    return false;
}

#else

/* What a block sees, bounce by bounce. */
typedef struct UniformBlock {
    Facet facets[CLASSIFIED_BOUNCES];
    int count;
} UniformBlock;

/* False: not all is told. */
NOINLINE bool make_uniform_block(const World *world, const Classification *o, UniformBlock *told)
{
    constant const Parameters *parameters = world->parameters;
    Camera camera = camera_of(world);
    for (int bounce = 0; bounce < o->bounces; bounce++) {
        Facet *f = told->facets + bounce;
        told->count = bounce + 1;
        facet_of(world, o->faces + bounce, &camera, bounce, f);
        if (f->face < 0)
            return true;
        if (parameters->light_count > CLASSIFIED_LIGHTS)
            return false;
        bool lit = parameters->shadow_ambient;
        for (int i = 0; i < parameters->light_count; i++) {
            global const real *light = world->lights + i * LIGHT_REALS;
            bool facing = o->facing[bounce] >> i & 1, clear = o->clear[bounce] >> i & 1, dark = o->dark[bounce] >> i & 1;
            if (asks_light(world, light, facing) && !clear && !dark)
                return false;
            facet_add_light(world, light, facing, clear ? LIT : SHADOWED, 0, f);
            lit |= clear;
        }
        if (f->reflection == 0 || bounce == parameters->max_bounces || !lit)
            return true;
        camera = camera_in_mirror(world, f->face, &camera);
    }
    return false;
}

/* What a tile has counted: rays bounce by bounce, and those that ended because what was to come is too weak. */
typedef struct UniformCounts {
    uint rays[CLASSIFIED_BOUNCES], weak;
} UniformCounts;

/* Follows a packet's rays. False: a sketch is too rough. */
INLINE bool shade_uniform_packet(const World *world, const UniformBlock *told, const ScreenPlaces *places, int p,
                                 Mask active, Vec *total, UniformCounts *counts)
{
    real weight = 1;
    *total = vec(0, 0, 0);
    for (int bounce = 0;; bounce++) {
        const Facet *f = told->facets + bounce;
        counts->rays[bounce] += mask_count(active);
        Vec colour = f->face < 0 ? vec_row(world->view + VIEW_BACKGROUND) : vec(0, 0, 0);
        Mask lit = (Mask)0;
        if (f->face >= 0 && !shade_facet(world, f, places, p, active, &colour, &lit))
            return false;
        *total = vec_select(active, vec_add(*total, vec_scale((Lanes)weight, colour)), *total);
        if (bounce + 1 == told->count)
            return true;
        weight *= f->reflection;
        Mask weak = active & too_weak(world, *total, (Lanes)weight);
        counts->weak += mask_count(weak);
        active &= ~weak;
        if (!ANY(active))
            return true;
    }
}

/* Renders a tile of such a block; rgb: as render_tile. False: a sketch is too rough, and nothing is done. */
NOINLINE bool render_uniform_tile(const World *world, const UniformBlock *told, int first_column, int first_row,
                                  global uchar *rgb)
{
    constant const Parameters *p = world->parameters;
    Vec sum[PACKETS];
    EACH_PACKET(k)
        sum[k] = vec(0, 0, 0);
    UniformCounts counts = {{0}, 0};
    for (int j = 0; j < p->grid; j++)
        for (int i = 0; i < p->grid; i++) {
            ScreenPlaces places = screen_places(world, first_column, p->first_row + first_row, i, j);
            EACH_PACKET(k) {
                Mask inside = pixels_inside(p, first_column, first_row, k);
                Vec total;
                if (!ANY(inside))
                    continue;
                if (!shade_uniform_packet(world, told, &places, k, inside, &total, &counts))
                    return false;
                sum[k] = vec_add(sum[k], total);
            }
        }
    store_tile(p, first_column, first_row, sum, rgb);
    world->counters[COUNT_PRIMARY] += counts.rays[0];
    world->counters[COUNT_SKIPPED + SKIP_WEAK_BOUNCE] += counts.weak;
    for (int bounce = 0; bounce < told->count; bounce++) {
        world->counters[COUNT_REFLECTION] += bounce > 0 ? counts.rays[bounce] : 0;
        count_facet(world, told->facets + bounce, counts.rays[bounce]);
    }
    return true;
}

#endif
