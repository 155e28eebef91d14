/* The kernel for GPUs: plain.cl in float alone, one ray per work-item. Where float cannot be sure of an answer, the
 * pixel goes to a list, and gpu_exact.cl renders it in plain.cl's exact arithmetic. A GPU is as much as 64 times slower
 * in double, and has few registers for each work-item. docs/gpu.md tells more. */
#include "shared/layout.h"
#include "shared/precision.cl"
#include "plain/scene.cl"
#include "gpu/path.cl"
#include "gpu/pixels.cl"

/* Traces the samples of a pixel. Its sums lie in the memory of the group: registers are for the search. */
static void sample_pixel(Scene *scene, int column, int row, local PixelSums *sums, volatile local uint *group_counts)
{
    volatile constant const Parameters *p = scene->parameters;
    for (int k = 0; k < p->grid * p->grid; k++) {
        int grid = p->grid, each = samples_per_share(grid * grid);
        begin_share(sums, k / each);
        if (trace_path(scene, primary_ray(scene, column, row, k % grid, k / grid), sums->share)) {
            scene->counts[COUNT_PRIMARY] = 1;
        } else {
            doubt_share(sums, k / each);
            forget_rays(scene); /* the exact pass counts its own */
        }
        add_to_group(group_counts, scene);
    }
}

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
        local PixelSums *sums = group_sums + item;
        begin_sums(sums);
        sample_pixel(&scene, parameters->first_column + at.x, first_row + at.y, sums, group_counts);
        end_share(sums);
        int pixel = at.y * columns + at.x, grid = parameters->grid;
        if (sums->doubts[0] | sums->doubts[1])
            store_doubt(doubt_count, doubts, pixel, sums);
        else
            store_colour(picture, pixel, vload3(0, sums->sum) / (grid * grid));
    }
    barrier(CLK_LOCAL_MEM_FENCE);
    if (item < COUNTER_KINDS && group_counts[item])
        atomic_add(totals + get_group_id(0) % COUNTER_STRIPES * COUNTER_STRIDE + item, group_counts[item]);
}
