/* The kernel `render` without a classification of tiles: in double, and with one lane. A tile of packets is traced at a
 * time.
 *
 *     for each tile of the work-item's block
 *         for each sample of a pixel
 *             all rays of the tile miss all faces: it sees the background
 *             else trace the paths of all its packets
 *         store the means of the samples
 *
 * tile/render.cl stands beside it: it finds out first what all rays of a tile have in common. */
#include "shared/compiler.cl"
#include "shared/layout.h"
#include "shared/precision.cl"
#include "packet/apex.cl"
#include "packet/background.cl"
#include "packet/camera.cl"
#include "packet/lanes.cl"
#include "packet/paths.cl"
#include "packet/picture.cl"
#include "packet/rays.cl"
#include "packet/tiles.cl"
#include "packet/trace.cl"
#include "packet/tree.cl"
#include "packet/vectors.cl"
#include "packet/window.cl"
#include "packet/world.cl"

/* The tile that begins there; rgb: band_rows * band_columns * 3 bytes. */
COMPILED_ONCE void render_tile(const World *world, const Apex *apex, const Camera *camera, int first_column,
                               int first_row, global uchar *rgb)
{
    constant const Parameters *p = world->parameters;
    Mask inside[PACKETS];
    Vec sum[PACKETS];
    EACH_PACKET(k) {
        inside[k] = pixels_inside(p, first_column, first_row, k);
        sum[k] = vec(0, 0, 0);
    }
    for (int j = 0; j < p->grid; j++)
        for (int i = 0; i < p->grid; i++) {
            ScreenPlaces places = screen_places(world, first_column, first_row, i, j);
            Window window = window_of_tile(p, &places, first_column, first_row);
            Frustum corners = camera_frustum(camera, &window);
            RayBounds seen = bounds_of_frustum(apex, &corners, 0);
            if (is_empty(world, &seen)) {
                see_background(world, inside, sum);
                continue;
            }
            Path paths[PACKETS];
            Ray rays[PACKETS];
            EACH_PACKET(k) {
                paths[k].active = inside[k];
                world->counters[COUNT_PRIMARY] += mask_count(inside[k]);
                rays[k].origin = wide_of(camera->eye);
                rays[k].direction = camera_direction(camera, &places, k);
            }
            begin_paths(paths, rays);
            Eye eye = {camera->eye, apex, &seen};
            trace_paths(world, &eye, 0, paths, rays, 0, 0);
            EACH_PACKET(k)
                sum[k] = vec_add(sum[k], paths[k].total);
        }
    store_tile(p, first_column, first_row, sum, rgb);
}

/* Do all rays of the area miss all faces? With one lane a block is one tile, and render_tile finds out. */
INLINE bool is_empty_area(const World *world, const Apex *apex, const Camera *camera, const Area *area)
{
    if (BLOCK_AREAS == 1)
        return false;
    Window window = window_of_area(world, area);
    Frustum corners = camera_frustum(camera, &window);
    RayBounds seen = bounds_of_frustum(apex, &corners, 0);
    return is_empty(world, &seen);
}

/* Renders a block of tiles: at once if it is empty, or else quarter by quarter. */
NOINLINE void render_block(const World *world, const Apex *apex, const Camera *camera, int block, global uchar *rgb)
{
    constant const Parameters *p = world->parameters;
    for (int k = 0; k < BLOCK_AREAS; k++) {
        Area area = area_of_block(p, block, k);
        if (area.columns <= 0 || area.rows <= 0)
            continue;
        bool is_block = BLOCK_AREAS > 1 && k == 0;
        if (is_empty_area(world, apex, camera, &area)) {
            render_background(world, &area, (uint)(area.columns * area.rows) * (uint)(p->grid * p->grid), rgb);
            if (is_block)
                return;
            continue;
        }
        if (is_block)
            continue;
        for (int row = area.row; row < area.row + area.rows; row += TILE_ROWS)
            for (int column = area.column; column < area.column + area.columns; column += TILE_COLUMNS)
                render_tile(world, apex, camera, column, row, rgb);
    }
}

/* One work-item per block of the band; surplus work-items do nothing. */
NOINLINE void render_item(const World *world, global uchar *rgb, volatile global uint *totals)
{
    Apex apex = apex_at_eye(world);
    Camera camera = camera_of(world);
    render_block(world, &apex, &camera, world->item, rgb);
    add_counters(totals, world);
}

kernel FULL_LANES
void render(constant Parameters *parameters, global const FaceRecord *faces, global const real *face_rows,
            global const wide *planes, global const real *materials, global const real *lights,
            global const real *view, global uchar *rgb, volatile global uint *totals,
            global const float *tree_floats, global const int *tree_ints)
{
    uint counters[COUNTER_KINDS] = {0};
    World world = {parameters, faces, face_rows, planes, parameters->face_count, materials, lights,
                   view, tree_floats, tree_ints, (int)get_global_id(0), counters};
    render_item(&world, rgb, totals);
}
