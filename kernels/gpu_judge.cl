/* Which pixels need more than the ray through their centre: what adaptive/ decides for packets, for one pixel per
 * work-item. gpu_adaptive.cl has traced the centres. */
#include "shared/layout.h"
#include "shared/precision.cl"
#include "packet/camera.cl"
#include "packet/lanes.cl"
#include "packet/trace.cl"
#include "packet/vectors.cl"
#include "packet/world.cl"
#include "adaptive/adaptive.cl"
#include "adaptive/direction.cl"

enum { SQUARE = 8, SQUARE_PIXELS = SQUARE * SQUARE };

/* The path through the centre of a pixel, of a band of so many. */
static Trail trail_at(global const int *trails, int pixel, int pixels)
{
    Trail trail;
    trail.count = trails[TRAIL_COUNT * (size_t)pixels + pixel];
    for (int hit = 0; hit < trail.count; hit++)
        trail.faces[hit] = trails[(TRAIL_FACES + hit) * (size_t)pixels + pixel];
    return trail;
}

/* Will the centre do for the pixel in that column and row of the picture? */
static bool is_even(const World *world, const Trail *trail, int column, int row)
{
    Tile tile = {{direction_to(world, column, row, 0, 0)}, {column}, {row}};
    Mask even[PACKETS] = {(Mask)-1};
    judge_pixels(world, trail, &tile, even);
    return even[0] != 0;
}

/* A work-item for each pixel of the band; 64 in a row are a square of it. Puts those that need more on the list
 * `refined`. */
kernel void judge_centres(constant Parameters *parameters, global const FaceRecord *faces,
                          global const real *face_rows, global const wide *planes, global const real *materials,
                          global const real *lights, global const real *view, global const float *tree_floats,
                          global const int *tree_ints, volatile global uint *totals, global const int *trails,
                          volatile global uint *refined_count, global uint *refined, int first_row, int band_rows)
{
    uint counters[COUNTER_KINDS] = {0};
    int columns = parameters->band_columns, across = (columns + SQUARE - 1) / SQUARE;
    int item = (int)get_global_id(0), square = item / SQUARE_PIXELS, in_square = item % SQUARE_PIXELS;
    int column = square % across * SQUARE + in_square % SQUARE, row = square / across * SQUARE + in_square / SQUARE;
    if (column >= columns || row >= band_rows)
        return;
    World world = {parameters, faces, face_rows, planes, parameters->face_count, materials, lights,
                   view, tree_floats, tree_ints, item, counters};
    int pixel = row * columns + column;
    Trail trail = trail_at(trails, pixel, columns * band_rows);
    if (!is_even(&world, &trail, parameters->first_column + column, first_row + row))
        refined[atomic_inc(refined_count)] = (uint)pixel;
    add_counters(totals, &world);
}
