/* The exact passes of gpu_adaptive.cl: that of the centres, and gpu_exact.cl for the samples. */
#include "plain.cl"
#include "gpu/pixels.cl"
#include "gpu/trail.cl"
#include "gpu_exact.cl"

/* Follows a path of so many hits once more, and keeps their faces. */
static void follow_path(Scene *scene, Ray ray, int hits, Trail trail)
{
    for (int k = 0; k < hits; k++) {
        Hit hit = nearest_hit(scene, ray);
        keep_hit(trail, k, hit.face);
        if (hit.face < 0)
            return;
        place_hit(scene, ray, &hit);
        wide3 r = unit_or_zero(ray.direction);
        ray = (Ray){hit.shifted, r - 2 * vec3_dot(r, hit.normal) * hit.normal, hit.face}; /* as in trace_path */
    }
}

/* The ray through the centre of a pixel on the list. */
static Ray ray_of_entry(const Scene *scene, global const uint *entry, int first_row)
{
    constant const Parameters *p = scene->parameters;
    int pixel = (int)entry[DOUBT_PIXEL];
    return primary_ray(scene, p->first_column + pixel % p->band_columns, first_row + pixel / p->band_columns, 0, 0);
}

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
        int pixel = (int)entry[DOUBT_PIXEL];
        Trail trail = trail_of(trails, pixel, parameters->band_columns * band_rows);
        store_pixel(picture, pixel, sum_of_pixel(&scene, entry, first_row));
        end_trail(trail, &scene);
        follow_path(&scene, ray_of_entry(&scene, entry, first_row), 1 + (int)scene.counts[COUNT_REFLECTION], trail);
        add_counts(totals, &scene);
    }
}
