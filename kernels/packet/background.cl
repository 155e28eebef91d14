/* Tiles, and blocks of tiles, whose rays miss all faces: they show the background, and no ray of theirs is traced. */
#include "shared/compiler.cl"
#include "shared/layout.h"
#include "shared/skips.h"
#include "packet/lanes.cl"
#include "packet/picture.cl"
#include "packet/tiles.cl"
#include "packet/vectors.cl"
#include "packet/world.cl"

INLINE void count_background(const World *world, uint rays)
{
    world->counters[COUNT_PRIMARY] += rays;
    world->counters[COUNT_SKIPPED + SKIP_EMPTY_TILE] += rays;
}

/* Adds one sample of the background to each pixel of a tile. */
INLINE void see_background(const World *world, const Mask *inside, Vec *sum)
{
    Vec background = vec_row(world->view + VIEW_BACKGROUND);
    EACH_PACKET(k) {
        sum[k] = vec_add(sum[k], background);
        count_background(world, mask_count(inside[k]));
    }
}

/* Fills an area with the background. */
INLINE void render_background(const World *world, const Area *area, uint rays, global uchar *rgb)
{
    constant const Parameters *p = world->parameters;
    Vec background = vec_row(world->view + VIEW_BACKGROUND), sum = vec(0, 0, 0);
    int samples = p->grid * p->grid;
    for (int i = 0; i < samples; i++)
        sum = vec_add(sum, background);
    Vec mean = samples > 1 ? vec(sum.x / samples, sum.y / samples, sum.z / samples) : sum;
    for (int row = 0; row < area->rows; row += PACKET_ROWS)
        for (int column = 0; column < area->columns; column += PACKET_COLUMNS)
            store_packet(rgb, p, area->column + column, area->row + row, mean);
    count_background(world, rays);
}
