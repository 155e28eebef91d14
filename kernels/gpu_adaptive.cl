/* Adaptive sampling on GPUs: the kernels in float. Five launches render a band:
 *
 *     render_centres          the ray through each pixel's centre, and the faces that it met
 *     render_centre_doubts    those centres of which float was not sure, exactly (gpu_adaptive_exact.cl)
 *     judge_centres           lists the pixels for which the centre will not do (gpu_judge.cl)
 *     render_refined          a lattice of samples of each pixel on that list
 *     render_doubts           of those the ones of which float was not sure, exactly (gpu_exact.cl)
 *
 * The order of the lists differs from run to run. No pixel depends on it. */
#include "shared/layout.h"
#include "shared/precision.cl"
#include "plain/scene.cl"
#include "gpu/pixels.cl"
#include "gpu/samples.cl"
#include "gpu/trail.cl"

/* As render_float in gpu.cl. trails: see TRAIL_COUNT. */
kernel __attribute__((reqd_work_group_size(GROUP_ITEMS, 1, 1)))
void render_centres(constant Parameters *parameters, global const FaceRecord *faces, global const real *face_rows,
                    global const real *materials, global const real *lights, global const real *view,
                    global const float *tree_floats, global const int *tree_ints, volatile global uint *totals,
                    volatile global uint *doubt_count, global uint *doubts, global int *trails,
                    global uchar *picture, int first_row, int band_rows)
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
        int pixel = at.y * columns + at.x;
        sample_pixel(&scene, parameters->first_column + at.x, first_row + at.y,
                     trail_of(trails, pixel, columns * band_rows), sums, group_counts);
        store_sums(&scene, pixel, sums, list, picture);
    }
    barrier(CLK_LOCAL_MEM_FENCE);
    add_group(totals, group_counts);
}

/* Each work-item refines a pixel of the list. There are as many work-items as the band has pixels, for the host does
 * not know how long the list is. */
kernel __attribute__((reqd_work_group_size(GROUP_ITEMS, 1, 1)))
void render_refined(constant Parameters *parameters, global const FaceRecord *faces, global const real *face_rows,
                    global const real *materials, global const real *lights, global const real *view,
                    global const float *tree_floats, global const int *tree_ints, volatile global uint *totals,
                    volatile global uint *doubt_count, global uint *doubts, global const uint *refined_count,
                    global const uint *refined, global uchar *picture, int first_row)
{
    local uint group_counts[COUNTER_KINDS];
    local PixelSums group_sums[GROUP_ITEMS];
    int item = (int)get_local_id(0);
    if (item < COUNTER_KINDS)
        group_counts[item] = 0;
    barrier(CLK_LOCAL_MEM_FENCE);
    if (get_global_id(0) < *refined_count) {
        Scene scene = {parameters, faces, face_rows, 0, materials, lights, view, tree_floats, tree_ints, {0}};
        DoubtList list = {doubt_count, doubts};
        local PixelSums *sums = group_sums + item;
        int columns = parameters->band_columns, pixel = (int)refined[get_global_id(0)];
        sample_pixel(&scene, parameters->first_column + pixel % columns, first_row + pixel / columns, no_trail(), sums,
                     group_counts);
        store_sums(&scene, pixel, sums, list, picture);
    }
    barrier(CLK_LOCAL_MEM_FENCE);
    add_group(totals, group_counts);
}
