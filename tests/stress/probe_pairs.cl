/* probe.cl for devices without double: the same questions, asked of the kernels that compute in pairs of floats. Each
 * number of a ray, of t and of a point is two floats. */
#include "shared/layout.h"
#include "shared/precision.cl"
#include "plain/scene.cl"
#include "pairs/face.cl"
#include "pairs/pair.cl"
#include "pairs/path.cl"
#include "pairs/search.cl"
#include "pairs/vector.cl"

static PairRay probe_ray(global const float *rays, size_t i)
{
    return pair_ray(pairs_at(rays + 12 * i), pairs_at(rays + 12 * i + 6), -1);
}

static void put_pairs(global float *out, PairVec a)
{
    vstore2((float2)(a.x.high, a.x.low), 0, out);
    vstore2((float2)(a.y.high, a.y.low), 1, out);
    vstore2((float2)(a.z.high, a.z.low), 2, out);
}

kernel void probe_counts(constant Parameters *parameters, global const FaceRecord *faces, global const real *face_rows,
                         global const wide *planes, global const float *rays, global int *counts,
                         global const real *view)
{
    Scene scene = {parameters, faces, face_rows, planes, 0, 0, view, 0, 0, {0}};
    size_t i = get_global_id(0);
    int count = 0;
    if (i >= (size_t)parameters->ray_count)
        return;
    PairRay ray = probe_ray(rays, i);
    FloatSearch s;
    PairHit hit;
    begin_search(&scene, &ray, &s);
    for (int face = 0; face < parameters->face_count; face++)
        count += may_meet(&scene, &s, face, INFINITY) && face_test(&scene, face, &ray, &hit);
    counts[i] = count;
}

kernel void probe_blocked(constant Parameters *parameters, global const FaceRecord *faces, global const real *face_rows,
                          global const wide *planes, global const float *segments, global const int *left,
                          global int *blocked, global const real *view)
{
    Scene scene = {parameters, faces, face_rows, planes, 0, 0, view, 0, 0, {0}};
    size_t i = get_global_id(0);
    if (i >= (size_t)parameters->ray_count)
        return;
    PairVec from = pairs_at(segments + 12 * i), to = pairs_at(segments + 12 * i + 6);
    blocked[i] = is_blocked(&scene, &from, &to, left[i]);
}

kernel void probe_points(constant Parameters *parameters, global const FaceRecord *faces, global const real *face_rows,
                         global const wide *planes, global const real *materials, global const real *lights,
                         global const real *view, global const float *rays, global int *hits, global float *t,
                         global float *points)
{
    Scene scene = {parameters, faces, face_rows, planes, materials, lights, view, 0, 0, {0}};
    size_t i = get_global_id(0);
    if (i >= (size_t)parameters->ray_count)
        return;
    PairVec direction = pairs_at(rays + 12 * i + 6);
    PairRay ray = probe_ray(rays, i);
    PairHit hit = nearest_hit(&scene, &ray);
    Pair its_t = pair_ldexp(hit.t, to_near_one(&direction));
    hits[i] = hit.face;
    vstore2((float2)(its_t.high, its_t.low), i, t);
    if (hit.face < 0)
        return;
    place_hit(&scene, &ray, &hit);
    put_pairs(points + 12 * i, hit.point);
    put_pairs(points + 12 * i + 6, hit.shifted);
}

kernel void probe_colours(constant Parameters *parameters, global const FaceRecord *faces, global const real *face_rows,
                          global const wide *planes, global const real *materials, global const real *lights,
                          global const real *view, global const float *rays, global real *colours)
{
    Scene scene = {parameters, faces, face_rows, planes, materials, lights, view, 0, 0, {0}};
    size_t i = get_global_id(0);
    if (i >= (size_t)parameters->ray_count)
        return;
    vstore3(trace_path(&scene, probe_ray(rays, i)), i, colours);
}

kernel void probe_powers(constant Parameters *parameters, global const float *pairs, global real *powers)
{
    size_t i = get_global_id(0);
    if (i < (size_t)parameters->ray_count)
        powers[i] = pow(pairs[4 * i], pairs[4 * i + 2]);
}
