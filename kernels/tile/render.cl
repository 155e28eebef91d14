/* The kernel `render` with a classification of tiles: in float, where it has double for exact rays. A work-item renders
 * a block of 4 x 4 tiles.
 *
 *     classify the block, and where it is mixed each quarter of it:
 *         empty:    all rays miss all faces; fill it with the background
 *         uniform:  all pixels see the same faces and lights; shade its packets one by one         (uniform_block.cl)
 *         mixed:    for each tile and sample
 *                       trace the tile as far as all its rays hit the same faces                   (uniform_tile.cl)
 *                       trace the rest in packets                                                  (packet/trace.cl)
 *
 * In rooms 80 to 97 % of the rays never leave the first two cases and the first half of the third. */
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
#include "tile/mirror_chain.cl"
#include "tile/uniform_block.cl"
#include "tile/uniform_tile.cl"

/* Renders the tile that begins there. classification: of the area around it. rgb: 3 bytes for each pixel of the band,
 * row by row. */
COMPILED_ONCE void render_tile(const World *world, const Apex *apex, const Camera *camera,
                               const Classification *classification, int first_column, int first_row, global uchar *rgb)
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
            if (!has_first_hit(classification) && is_empty(world, &seen)) {
                see_background(world, inside, sum);
                continue;
            }
            Path paths[PACKETS];
            Ray rays[PACKETS];
            EACH_PACKET(k) {
                paths[k].active = inside[k];
                world->counters[COUNT_PRIMARY] += mask_count(inside[k]);
            }
            Classification found;
            if (!trace_uniform_tile(world, &places, &window, classification, paths, rays, &found)) {
                Eye eye = {camera->eye, apex, &seen};
                trace_paths(world, &eye, found.bounces, paths, rays, &found.resume, 0);
            }
            EACH_PACKET(k)
                sum[k] = vec_add(sum[k], paths[k].total);
        }
    store_tile(p, first_column, first_row, sum, rgb);
}

typedef enum TileClass { TILE_MIXED, TILE_UNIFORM, TILE_EMPTY } TileClass;

/* Classifies an area of so many rays. parent: of the area around it, or NULL. TILE_UNIFORM: the block is made. */
INLINE TileClass classify_area(const World *world, const Apex *apex, const Camera *camera, const Area *area, uint rays,
                               const Classification *parent, Classification *found, UniformBlock *block)
{
    Window window = window_of_area(world, area);
    Frustum corners = camera_frustum(camera, &window);
    RayBounds seen = bounds_of_frustum(apex, &corners, 0);
    if (!(parent && has_first_hit(parent)) && is_empty(world, &seen))
        return TILE_EMPTY;
    return classify_window(world, &window, rays, parent, found, block) ? TILE_UNIFORM : TILE_MIXED;
}

/* Renders a block of tiles: at once if its rays have all in common, or else quarter by quarter. */
NOINLINE void render_block(const World *world, const Apex *apex, const Camera *camera, int block, global uchar *rgb)
{
    constant const Parameters *p = world->parameters;
    Classification classifications[2]; /* the block's, its quarter's */
    UniformBlock uniform;
    for (int k = 0; k < BLOCK_AREAS; k++) {
        Area area = area_of_block(p, block, k);
        if (area.columns <= 0 || area.rows <= 0)
            continue;
        uint rays = (uint)(area.columns * area.rows) * (uint)(p->grid * p->grid);
        Classification *parent = k > 0 ? classifications : 0, *found = classifications + (k > 0);
        TileClass tile_class = classify_area(world, apex, camera, &area, rays, parent, found, &uniform);
        if (k == 0 && tile_class == TILE_MIXED)
            continue;
        if (tile_class == TILE_EMPTY)
            render_background(world, &area, rays, rgb);
        else
            for (int row = area.row; row < area.row + area.rows; row += TILE_ROWS)
                for (int column = area.column; column < area.column + area.columns; column += TILE_COLUMNS)
                    if (tile_class != TILE_UNIFORM || !render_uniform_tile(world, &uniform, column, row, rgb))
                        render_tile(world, apex, camera, found, column, row, rgb);
        if (k == 0)
            return;
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
