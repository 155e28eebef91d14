/* The exact passes of gpu_adaptive.cl: that of the centres, and gpu_exact.cl for the samples. */
#include FOLLOW
#include "gpu/pixels.cl"
#include "gpu/trail.cl"
#include "gpu_exact.cl"

/* As render_doubts. trails: see TRAIL_COUNT. */
kernel void render_centre_doubts(constant Parameters *parameters, global const FaceRecord *faces,
                                 global const real *face_rows, global const wide *planes,
                                 global const real *materials, global const real *lights, global const real *view,
                                 global const float *tree_floats, global const int *tree_ints,
                                 volatile global uint *totals, global const uint *doubt_count,
                                 global const uint *doubts, global int *trails, global uchar *picture, int first_row,
                                 int band_rows)
{
    for (uint i = (uint)get_global_id(0); i < *doubt_count; i += (uint)get_global_size(0)) {
        Scene scene = {parameters, faces, face_rows, planes, materials, lights, view, tree_floats, tree_ints, {0}};
        global const uint *entry = doubts + (size_t)i * DOUBT_WORDS;
        int pixel = (int)entry[DOUBT_PIXEL], columns = parameters->band_columns;
        int column = parameters->first_column + pixel % columns, row = first_row + pixel / columns;
        Trail trail = trail_of(trails, pixel, columns * band_rows);
        store_pixel(picture, pixel, sum_of_pixel(&scene, entry, first_row));
        end_trail(trail, &scene);
        follow_path(&scene, primary_ray(&scene, column, row, 0, 0), 1 + (int)scene.counts[COUNT_REFLECTION], trail);
        add_counts(totals, &scene);
    }
}
