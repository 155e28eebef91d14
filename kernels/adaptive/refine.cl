/* The kernel `render_adaptive`. It runs twice.
 *
 *     first, for each tile:                      trace the rays through the centres of its pixels
 *                                                flag the pixels for which the centre will not do (adaptive.cl)
 *     then, for each PACKETS of flagged pixels:  trace a lattice of samples of each; store the means
 *
 * A lattice has one sample in each of N columns and N rows (Sloan, Joe, "Lattice Methods for Multiple Integration",
 * 1994). With adaptive:8 the gallery has the error of 8 x 8 rays for a tenth of its time (docs/accuracy.md). */
#include "shared/compiler.cl"
#include "shared/layout.h"
#include "shared/precision.cl"
#include "packet/apex.cl"
#include "packet/camera.cl"
#include "packet/lanes.cl"
#include "packet/paths.cl"
#include "packet/picture.cl"
#include "packet/rays.cl"
#include "packet/tiles.cl"
#include "packet/trace.cl"
#include "packet/tree.cl"
#include "packet/vectors.cl"
#include "packet/world.cl"
#include "adaptive/adaptive.cl"
#include "adaptive/direction.cl"

/* Bounds of the active rays, which start at the apex. */
static RayBounds bounds_of_rays(const Apex *a, const Path *paths, const Ray *rays)
{
    OriginPacket packets[PACKETS];
    EACH_PACKET(k) {
        packets[k].active = paths[k].active;
        packets[k].ahead = vec_to_real(rays[k].direction);
    }
    return bounds_from(a, packets, PACKETS, 0);
}

/* Renders the centres of a tile's pixels. flags: band_rows * band_columns bytes, 1 where a pixel needs more samples. */
COMPILED_ONCE void render_centres(const World *world, int first_column, int first_row, global uchar *rgb,
                                  global uchar *flags)
{
    constant const Parameters *p = world->parameters;
    Apex apex = apex_at_eye(world);
    Path paths[PACKETS];
    Ray rays[PACKETS];
    Trail trails[PACKETS];
    Tile pixels;
    Mask even[PACKETS];
    EACH_PACKET(k) {
        Mask number = lane_numbers();
        pixels.columns[k] = MASK_TO_WIDE(p->first_column + first_column + PACKET_COLUMN(k) + number % PACKET_COLUMNS);
        pixels.rows[k] = MASK_TO_WIDE(p->first_row + first_row + PACKET_ROW(k) + number / PACKET_COLUMNS);
        rays[k].origin = view_vec(world, VIEW_EYE);
        rays[k].direction = pixels.directions[k] =
            direction_to(world, pixels.columns[k], pixels.rows[k], (Wide)0, (Wide)0);
        paths[k].active = even[k] = pixels_inside(p, first_column, first_row, k);
        trails[k].count = 0;
        world->counters[COUNT_PRIMARY] += mask_count(even[k]);
    }
    RayBounds seen = bounds_of_rays(&apex, paths, rays);
    begin_paths(paths, rays);
    Camera camera = camera_of(world);
    Eye eye = {camera.eye, &apex, &seen};
    trace_paths(world, &eye, 0, paths, rays, 0, trails);
    judge_pixels(world, trails, &pixels, even);
    EACH_PACKET(k) {
        int column = first_column + PACKET_COLUMN(k), row = first_row + PACKET_ROW(k);
        store_packet(rgb, p, column, row, paths[k].total);
        MaskElement even_lanes[LANES];
        STORE(even[k], even_lanes);
        for (int i = 0; i < LANES; i++) {
            int c = column + i % PACKET_COLUMNS, r = row + i / PACKET_COLUMNS;
            if (c < p->band_columns && r < p->band_rows)
                flags[(size_t)r * (size_t)p->band_columns + (size_t)c] = even_lanes[i] ? 0 : 1;
        }
    }
}

/* --- Refining --- */

/* A pixel on the list, and the sum of its samples. */
typedef struct Refined {
    int place, column, row; /* in the band; in the picture */
    real sum[3];
} Refined;

/* Adds the first `count` lanes, in their order. */
static void add_samples(Refined *pixel, Vec colour, int count)
{
    real lanes[3][LANES];
    STORE(colour.x, lanes[0]);
    STORE(colour.y, lanes[1]);
    STORE(colour.z, lanes[2]);
    for (int c = 0; c < 3; c++)
        for (int i = 0; i < count; i++)
            pixel->sum[c] += lanes[c][i];
}

/* Traces samples first, first + 1, ... of each pixel, a packet for each: see adaptive_generator. */
COMPILED_ONCE void trace_samples(const World *world, const Apex *apex, Refined *pixels, int pixel_count, int first)
{
    constant const Parameters *p = world->parameters;
    int count = min(p->grid - first, LANES);
    Mask lane = lane_numbers(), i = lane + first, j = i * p->generator % p->grid;
    Path paths[PACKETS];
    Ray rays[PACKETS];
    EACH_PACKET(k) {
        const Refined *pixel = pixels + min(k, pixel_count - 1);
        rays[k].origin = view_vec(world, VIEW_EYE);
        rays[k].direction =
            direction_to(world, (Wide)(wide)pixel->column, (Wide)(wide)pixel->row, MASK_TO_WIDE(i), MASK_TO_WIDE(j));
        paths[k].active = k < pixel_count ? IS(lane < (Mask)count) : (Mask)0;
    }
    world->counters[COUNT_PRIMARY] += (uint)(pixel_count * count);
    RayBounds seen = bounds_of_rays(apex, paths, rays);
    begin_paths(paths, rays);
    Camera camera = camera_of(world);
    Eye eye = {camera.eye, apex, &seen};
    trace_paths(world, &eye, 0, paths, rays, 0, 0);
    for (int k = 0; k < pixel_count; k++)
        add_samples(pixels + k, paths[k].total, count);
}

/* Refines neighbours in the list of pixels. list: places in the band. */
static void refine(const World *world, global uchar *rgb, global const int *list)
{
    constant const Parameters *p = world->parameters;
    int first = world->item * PACKETS, pixel_count = min(p->refine_count - first, PACKETS);
    if (pixel_count <= 0)
        return;
    Apex apex = apex_at_eye(world);
    Refined pixels[PACKETS];
    for (int k = 0; k < pixel_count; k++) {
        int place = list[p->refine_first + first + k];
        Refined pixel = {place, p->first_column + place % p->band_columns, p->first_row + place / p->band_columns,
                         {0, 0, 0}};
        pixels[k] = pixel;
    }
    for (int sample = 0; sample < p->grid; sample += LANES)
        trace_samples(world, &apex, pixels, pixel_count, sample);
    real samples = p->grid;
    for (int k = 0; k < pixel_count; k++) {
        const real *sum = pixels[k].sum;
        store_pixel(rgb, pixels[k].place, sum[0] / samples, sum[1] / samples, sum[2] / samples);
    }
}

/* A work-item for a block of the band's tiles; where refine_count says that there are pixels to refine, one for PACKETS
 * of them. Both in one kernel, for tracing a path is the most of it, and takes the longest to compile. */
NOINLINE void render_item(const World *world, global uchar *rgb, global uchar *flags, global const int *list,
                          volatile global uint *totals)
{
    constant const Parameters *p = world->parameters;
    if (p->refine_count > 0) {
        refine(world, rgb, list);
    } else {
        Area area = area_of_block(p, world->item, 0);
        for (int row = area.row; row < area.row + area.rows; row += TILE_ROWS)
            for (int column = area.column; column < area.column + area.columns; column += TILE_COLUMNS)
                render_centres(world, column, row, rgb, flags);
    }
    add_counters(totals, world);
}

kernel FULL_LANES
void render_adaptive(constant Parameters *parameters, global const FaceRecord *faces, global const real *face_rows,
                     global const wide *planes, global const real *materials, global const real *lights,
                     global const real *view, global uchar *rgb, volatile global uint *totals,
                     global const float *tree_floats, global const int *tree_ints, global uchar *flags,
                     global const int *list)
{
    uint counters[COUNTER_KINDS] = {0};
    World world = {parameters, faces, face_rows, planes, parameters->face_count, materials, lights,
                   view, tree_floats, tree_ints, (int)get_global_id(0), counters};
    render_item(&world, rgb, flags, list, totals);
}
