/* The exact pass of gpu.cl: the pixels on its list, in the exact arithmetic of the plain kernel. */
#include PLAIN
#include "gpu/pixels.cl"

/* The sum of a pixel's colours, those of its shares in doubt included. */
static float3 sum_of_pixel(Scene *scene, global const uint *entry, int first_row)
{
    constant const Parameters *p = scene->parameters;
    int pixel = (int)entry[DOUBT_PIXEL];
    int column = p->first_column + pixel % p->band_columns, row = first_row + pixel / p->band_columns;
    int samples = sample_count(p), each = samples_per_share(samples);
    float3 sum = as_float3(vload3(0, entry + DOUBT_SUM));
    for (int k = 0; k < samples; k++) {
        int share = k / each;
        if (entry[DOUBT_SHARE_BITS + share / 32] >> share % 32 & 1) {
            int2 at = place_of_sample(p, k);
            sum += trace_path(scene, primary_ray(scene, column, row, at.x, at.y));
            scene->counts[COUNT_PRIMARY]++;
        }
    }
    return sum;
}

/* Each work-item takes a pixel of the list, and the next ones as many places on as there are work-items. */
kernel void render_doubts(constant Parameters *parameters, global const FaceRecord *faces,
                          global const real *face_rows, global const wide *planes, global const real *materials,
                          global const real *lights, global const real *view, global const float *tree_floats,
                          global const int *tree_ints, volatile global uint *totals, global const uint *doubt_count,
                          global const uint *doubts, global uchar *picture, int first_row)
{
    Scene scene = {parameters, faces, face_rows, planes, materials, lights, view, tree_floats, tree_ints, {0}};
    for (uint i = (uint)get_global_id(0); i < *doubt_count; i += (uint)get_global_size(0)) {
        global const uint *entry = doubts + (size_t)i * DOUBT_WORDS;
        float3 sum = sum_of_pixel(&scene, entry, first_row);
        store_pixel(picture, entry[DOUBT_PIXEL], sum / sample_count(parameters));
    }
    add_counts(totals, &scene);
}
