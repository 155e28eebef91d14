/* Paths through a tile, and the kernel `render`, which turns a block of pixels per work-item into bytes. */
#include "shared/compiler.cl"
#include "shared/layout.h"
#include "shared/precision.cl"
#include "shared/skips.h"
#include "packet/apex.cl"
#include "packet/camera.cl"
#include "packet/lanes.cl"
#include "packet/nearest.cl"
#include "packet/paths.cl"
#include "packet/picture.cl"
#include "packet/rays.cl"
#include "packet/trace.cl"
#include "packet/tree.cl"
#include "packet/vectors.cl"
#include "packet/world.cl"
#include "tile/classify.cl"
#include "tile/frustum.cl"
#include "tile/uniform_block.cl"
#include "tile/uniform_tile.cl"

/* What rays see that miss all faces. */
INLINE void see_background(const World *world, const Mask *inside, Vec *sum)
{
    Vec background = vec_row(world->view + VIEW_BACKGROUND);
    EACH_PACKET(k) {
        uint rays = mask_count(inside[k]);
        sum[k] = vec_add(sum[k], background);
        world->counters[COUNT_PRIMARY] += rays;
        world->counters[COUNT_SKIPPED + SKIP_EMPTY_TILE] += rays;
    }
}

/* An area that misses all faces. */
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
    world->counters[COUNT_PRIMARY] += rays;
    world->counters[COUNT_SKIPPED + SKIP_EMPTY_TILE] += rays;
}

/* The tile that begins there; rgb: band_rows * columns * 3 bytes. */
INLINE void render_tile(const World *world, const Apex *apex, const Camera *camera,
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
            ScreenPlaces places = screen_places(world, first_column, p->first_row + first_row, i, j);
            Window window = window_of_tile(p, &places, first_column, first_row);
            Frustum corners = camera_frustum(camera, &window);
            if (MAY_SKIP(p, SKIP_EMPTY_TILE) && !has_first_hit(classification)) {
                RayBounds seen = bounds_of_frustum(apex, &corners, 0);
                if (misses_all(world, &seen)) {
                    see_background(world, inside, sum);
                    continue;
                }
            }
            Path paths[PACKETS];
            Ray rays[PACKETS];
            EACH_PACKET(k) {
                paths[k].active = inside[k];
                world->counters[COUNT_PRIMARY] += mask_count(inside[k]);
            }
            int bounces = 0;
#if CLASSIFIES_TILES
            Traversal rest;
            bool done = trace_uniform_tile(world, &places, &window, classification, paths, rays, &bounces, &rest);
            const Traversal *left = &rest;
#else
            EACH_PACKET(k) {
                rays[k].origin = wide_vec((Wide)camera->eye[0], (Wide)camera->eye[1], (Wide)camera->eye[2]);
                rays[k].direction = camera_direction(camera, &places, k);
            }
            begin_paths(paths, rays);
            bool done = false;
            const Traversal *left = 0;
#endif
            if (!done) {
                RayBounds seen = bounds_of_frustum(apex, &corners, 0);
                Eye eye = {camera->eye, apex, &seen};
                trace_paths(world, &eye, bounces, paths, rays, left, 0);
            }
            EACH_PACKET(k)
                sum[k] = vec_add(sum[k], paths[k].total);
        }
    store_tile(p, first_column, first_row, sum, rgb);
}

/* What the corners of an area tell of what it sees: not all of it, all of it, or that it is nothing. */
typedef enum TileClass { TILE_MIXED, TILE_UNIFORM, TILE_EMPTY } TileClass;

/* parent: as classify_window. outlook: filled but where it is empty, told: where all is told. */
INLINE TileClass classify_area(const World *world, const Apex *apex, const Camera *camera, const Area *area,
                               uint rays, const Classification *parent, Classification *classification,
                               UniformBlock *told)
{
    Window window = window_of_area(world, area);
    Frustum corners = camera_frustum(camera, &window);
    RayBounds seen = bounds_of_frustum(apex, &corners, 0);
    bool may_be_empty = MAY_SKIP(world->parameters, SKIP_EMPTY_TILE) && !(parent && has_first_hit(parent));
    if (may_be_empty && misses_all(world, &seen))
        return TILE_EMPTY;
    return classify_window(world, &window, rays, parent, classification) && make_uniform_block(world, classification, told) ? TILE_UNIFORM : TILE_MIXED;
}

/* Renders a block of tiles: at once if its corners tell all, or else quarter by quarter, and a quarter whose corners do not tell
 * all tile by tile. */
INLINE void render_block(const World *world, const Apex *apex, const Camera *camera, int block, global uchar *rgb)
{
    constant const Parameters *p = world->parameters;
    Classification classifications[2]; /* the block's, its quarter's */
    UniformBlock told;
    for (int k = 0; k < BLOCK_AREAS; k++) {
        Area area = area_of_block(p, block, k);
        if (area.columns <= 0 || area.rows <= 0)
            continue;
        uint rays = (uint)(area.columns * area.rows) * (uint)(p->grid * p->grid);
        Classification *classification = classifications + (k > 0);
        TileClass tile_class = TILE_MIXED;
        if (BLOCK_AREAS > 1) {
            tile_class = classify_area(world, apex, camera, &area, rays, k > 0 ? classifications : 0, classification, &told);
            if (k == 0 && tile_class == TILE_MIXED)
                continue;
        }
        if (tile_class == TILE_EMPTY)
            render_background(world, &area, rays, rgb);
        else
            for (int row = area.row; row < area.row + area.rows; row += TILE_ROWS)
                for (int column = area.column; column < area.column + area.columns; column += TILE_COLUMNS)
                    if (tile_class != TILE_UNIFORM || !render_uniform_tile(world, &told, column, row, rgb))
                        render_tile(world, apex, camera, classification, column, row, rgb);
        if (k == 0)
            return;
    }
}

/* One work-item per block of the band; surplus work-items do nothing. */
kernel void render(constant Parameters *parameters, global const FaceRecord *faces, global const real *edges,
                   global const wide *planes, global const real *materials, global const real *lights,
                   global const real *view, global uchar *rgb, volatile global uint *totals,
                   global const float *tree_floats, global const int *tree_ints)
{
    uint counters[COUNTER_KINDS] = {0};
    World world = {parameters, faces, edges, planes, parameters->face_count, materials, lights, view, tree_floats, tree_ints, counters};
    Apex apex = apex_at_eye(&world);
    Camera camera = camera_of(&world);
    render_block(&world, &apex, &camera, (int)get_global_id(0), rgb);
    add_counters(totals, &world);
}
