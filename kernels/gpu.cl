/* The kernel for GPUs: plain.cl in float alone, one ray per work-item. Where float cannot be sure of an answer, the
 * pixel goes to a list, and gpu_exact.cl renders it in plain.cl's exact arithmetic. A GPU is as much as 64 times slower
 * in double, and has few registers for each work-item. docs/gpu.md tells more. */
#include "shared/layout.h"
#include "shared/precision.cl"
#include "plain/scene.cl"
#include "gpu/pixels.cl"
#include "gpu/samples.cl"
#include "gpu/trail.cl"

/* Renders the rows first_row .. first_row + band_rows - 1 into `picture`. doubts: the list of the pixels in doubt,
 * *doubt_count how many they are. */
kernel __attribute__((reqd_work_group_size(GROUP_ITEMS, 1, 1)))
void render_float(constant Parameters *parameters, global const FaceRecord *faces, global const real *face_rows,
                  global const real *materials, global const real *lights, global const real *view,
                  global const float *tree_floats, global const int *tree_ints, volatile global uint *totals,
                  volatile global uint *doubt_count, global uint *doubts, global uchar *picture, int first_row,
                  int band_rows)
{
    local uint group_counts[COUNTER_KINDS];
    local PixelSums group_sums[GROUP_ITEMS];
    int item = (int)get_local_id(0);
    if (item < COUNTER_KINDS)
        group_counts[item] = 0;
    barrier(CLK_LOCAL_MEM_FENCE);
    int columns = parameters->band_columns;
    int2 at = pixel_of_item(columns);
    if (at.x < columns && at.y < band_rows) {
        Scene scene = {parameters, faces, face_rows, 0, materials, lights, view, tree_floats, tree_ints, {0}};
        DoubtList list = {doubt_count, doubts};
        local PixelSums *sums = group_sums + item;
        sample_pixel(&scene, parameters->first_column + at.x, first_row + at.y, no_trail(), sums, group_counts);
        store_sums(&scene, at.y * columns + at.x, sums, list, picture);
    }
    barrier(CLK_LOCAL_MEM_FENCE);
    add_group(totals, group_counts);
}
