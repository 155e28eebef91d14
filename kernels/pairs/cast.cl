/* The kernel `cast` for devices without double: the nearest faces of a list of rays, one ray for each work-item. */
#include "shared/layout.h"
#include "shared/precision.cl"
#include "plain/scene.cl"
#include "pairs/face.cl"
#include "pairs/pair.cl"
#include "pairs/search.cl"
#include "pairs/vector.cl"

/* Each number of `rays` and `hits_t` is two floats. rays: ray_count x (origin, direction). hits_face, hits_t: one for
 * each ray; -1 and 0 for a miss. */
kernel void cast(constant Parameters *parameters, global const FaceRecord *faces, global const real *face_rows,
                 global const wide *planes, global const float *rays, global int *hits_face, global float *hits_t,
                 volatile global uint *totals, global const float *tree_floats, global const int *tree_ints,
                 global const real *view)
{
    Scene scene = {parameters, faces, face_rows, planes, 0, 0, view, tree_floats, tree_ints, {0}};
    size_t i = get_global_id(0);
    if (i >= (size_t)parameters->ray_count)
        return;
    PairVec direction = pairs_at(rays + 12 * i + 6);
    PairRay ray = pair_ray(pairs_at(rays + 12 * i), direction, -1);
    PairHit nearest = nearest_hit(&scene, &ray);
    bool hit = nearest.face >= 0;
    Pair t = hit ? pair_ldexp(nearest.t, to_near_one(&direction)) : pair_of(0);
    hits_face[i] = hit ? faces[nearest.face].index : -1;
    hits_t[2 * i] = t.high;
    hits_t[2 * i + 1] = t.low;
    scene.counts[COUNT_PRIMARY] = 1;
    add_counts(totals, &scene);
}
