/* The plain kernel for devices without double. Rays, t and hit points are pairs of floats, the sum of both: 48 bits,
 * where double has 53. The steps and their names are those of plain.cl, which is to be read first; OpenCL C has no
 * operators for pairs, so that sums and products are calls here. Colours are floats.
 * It is the exact pass of gpu.cl, too: gpu_exact.cl. */
#include "shared/layout.h"
#include "shared/precision.cl"
#include "plain/scene.cl"
#include "pairs/pair.cl"
#include "pairs/path.cl"
#include "pairs/search.cl"
#include "pairs/vector.cl"

/* Step 1: the ray from the camera through sub-pixel (i, j) of a pixel. Places are counted from the middle of the
 * screen, in halves. */
static PairRay primary_ray(const Scene *scene, int column, int row, int i, int j)
{
    constant const Parameters *p = scene->parameters;
    int across = p->columns * p->grid, down = p->rows * p->grid;
    PairVec size = view_pairs(scene, VIEW_WIDTH); /* width, height */
    Pair x = pair_quotient(pair_of_int(2 * (column * p->grid + i) + 1 - across), pair_of_int(2 * across));
    Pair y = pair_quotient(pair_of_int(down - 1 - 2 * (row * p->grid + j)), pair_of_int(2 * down));
    PairVec sideways = pairs_times(pair_product(x, size.x), view_pairs(scene, VIEW_RIGHT));
    PairVec upwards = pairs_times(pair_product(y, size.y), view_pairs(scene, VIEW_UP));
    PairVec direction = pairs_sum(pairs_sum(view_pairs(scene, VIEW_FORWARD), sideways), upwards);
    return pair_ray(view_pairs(scene, VIEW_EYE), direction, -1);
}

/* Step 10: puts the colour into the picture as three bytes; with the build option LINEAR, as three numbers. */
static void store_pixel(global uchar *picture, size_t place, float3 colour)
{
    float rgb[3] = {colour.x, colour.y, colour.z};
    for (int i = 0; i < 3; i++)
#ifdef LINEAR
        ((global float *)picture)[3 * place + i] = rgb[i];
#else
        picture[3 * place + i] = (uchar)floor(255 * clamp(rgb[i], 0.0f, 1.0f) + 0.5f);
#endif
}

/* A work-item is a pixel of the band that this launch renders. */
kernel void render(constant Parameters *parameters, global const FaceRecord *faces, global const real *face_rows,
                   global const wide *planes, global const real *materials, global const real *lights,
                   global const real *view, global uchar *picture, volatile global uint *totals,
                   global const float *tree_floats, global const int *tree_ints)
{
    Scene scene = {parameters, faces, face_rows, planes, materials, lights, view, tree_floats, tree_ints, {0}};
    int pixel = (int)get_global_id(0), grid = parameters->grid;
    int column = pixel % parameters->band_columns, row = pixel / parameters->band_columns;
    if (row >= parameters->band_rows)
        return; /* the last group may have more work-items than there are pixels */
    float3 sum = (float3)0;
    for (int j = 0; j < grid; j++)
        for (int i = 0; i < grid; i++)
            sum += trace_path(&scene, primary_ray(&scene, parameters->first_column + column,
                                                  parameters->first_row + row, i, j));
    store_pixel(picture, pixel, sum / (grid * grid));
    scene.counts[COUNT_PRIMARY] = grid * grid;
    add_counts(totals, &scene);
}
