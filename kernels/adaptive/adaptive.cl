/* Adaptive sampling: which pixels need more than the ray through their centre. src/trace/adaptive.c says why.
 *
 *     until each pixel of the tile is in a group:
 *         group = the pixels whose centres have hit the same faces as the first one that is left
 *         judge_group: the pixels of the group for which the centre will do
 *
 * It costs beams for every pixel. It buys the error of 8 x 8 rays for a tenth of their time in rooms. One beam for a
 * whole group took the gallery from 469 to 277 ms. docs/kernels.md, section 16. */
#include "shared/compiler.cl"
#include "shared/layout.h"
#include "shared/precision.cl"
#include "packet/camera.cl"
#include "packet/lanes.cl"
#include "packet/trace.cl"
#include "packet/vectors.cl"
#include "packet/world.cl"
#include "adaptive/beam.cl"
#include "adaptive/judge.cl"
#include "adaptive/point.cl"

/* The lanes whose trail is that of one lane of `first`. */
INLINE Mask same_trail(const Trail *trail, const Trail *first, int lane, Mask active)
{
    for (int hit = 0; hit < trail->count; hit++)
        active &= IS(trail->faces[hit] == (Mask)trail_face(first, hit, lane));
    return active;
}

/* A tile's pixels, packet by packet: the directions to their middles, and where they are. */
typedef struct Tile {
    WideVec directions[PACKETS];
    Wide columns[PACKETS], rows[PACKETS];
} Tile;

/* The beams of a group's pixels. They are given by what lies between them and the pixel of that lane of the packet. */
static void beam_of_pixels(const World *world, const Tile *tile, int packet, int lane, const Mask *group, Beam *b)
{
    constant const Parameters *p = world->parameters;
    WideVec c = tile->directions[packet];
    b->c0 = point(wide_at(c.x, lane), wide_at(c.y, lane), wide_at(c.z, lane));
    b->apex = point(view_value(world, VIEW_EYE), view_value(world, VIEW_EYE + 1), view_value(world, VIEW_EYE + 2));
    b->u = point_scale(
        view_value(world, VIEW_WIDTH) / p->columns / 2,
        point(view_value(world, VIEW_RIGHT), view_value(world, VIEW_RIGHT + 1), view_value(world, VIEW_RIGHT + 2)));
    b->v =
        point_scale(view_value(world, VIEW_HEIGHT) / p->rows / 2,
                    point(view_value(world, VIEW_UP), view_value(world, VIEW_UP + 1), view_value(world, VIEW_UP + 2)));
    b->size = point_magnitudes(b->apex);
    b->mirrored = false;
    b->rounded = 0;
    /* From one pixel's middle to the next it is 2 u, or -2 v. */
    wide column = wide_at(tile->columns[packet], lane), row = wide_at(tile->rows[packet], lane);
    wide low[2] = {0, 0}, high[2] = {0, 0};
    EACH_PACKET(k) {
        b->lanes[k].c = tile->directions[k];
        wide across[LANES], down[LANES];
        STORE(2 * (tile->columns[k] - column), across);
        STORE(-2 * (tile->rows[k] - row), down);
        for (uint in = mask_bits(group[k]); in; in &= in - 1) {
            wide a[2] = {across[lowest_bit(in)], down[lowest_bit(in)]};
            for (int i = 0; i < 2; i++) {
                low[i] = a[i] < low[i] ? a[i] : low[i];
                high[i] = a[i] > high[i] ? a[i] : high[i];
            }
        }
    }
    for (int i = 0; i < 2; i++) {
        b->middle[i] = (low[i] + high[i]) / 2;
        b->extent[i] = (high[i] - low[i]) / 2 + 1;
    }
    beam_bounds(b);
}

/* Keeps those active lanes whose centre will do for the pixel. The pixels whose centres took the same path are a
 * group. */
COMPILED_ONCE void judge_pixels(const World *world, const Trail *trails, const Tile *tile, Mask *active)
{
    Mask rest[PACKETS];
    EACH_PACKET(k) {
        rest[k] = active[k];
        active[k] = (Mask)0;
    }
    for (int first = 0; first < PACKETS; first++)
        while (ANY(rest[first])) {
            int lane = lowest_bit(mask_bits(rest[first]));
            Mask group[PACKETS];
            EACH_PACKET(k) {
                group[k] = same_trail(trails + k, trails + first, lane, rest[k]);
                rest[k] &= ~group[k];
            }
            Judge j;
            j.world = world;
            j.weight = 1;
            beam_of_pixels(world, tile, first, lane, group, &j.beam);
            judge_group(&j, trails + first, lane, group);
            EACH_PACKET(k)
                active[k] |= group[k];
        }
}
