/* What the stress suite asks the product's kernels beside what the product asks: single functions of theirs, one
 * work-item per question, all lanes the same. Compiled with the kernel `cast`, every face asked in turn. */
#include "shared/layout.h"
#include "shared/precision.cl"
#include "packet/any_rays.cl"
#include "packet/apex.cl"
#include "packet/intersect.cl"
#include "packet/intersect_exactly.cl"
#include "packet/lanes.cl"
#include "packet/paths.cl"
#include "packet/points.cl"
#include "packet/power.cl"
#include "packet/rays.cl"
#include "packet/shadow.cl"
#include "packet/trace.cl"
#include "packet/tree.cl"
#include "packet/vectors.cl"
#include "packet/world.cl"

static WideVec probe_vec(global const wide *a, int i)
{
    return wide_vec((Wide)a[6 * i], (Wide)a[6 * i + 1], (Wide)a[6 * i + 2]);
}

static Ray probe_ray(global const wide *rays, int i)
{
    Ray ray = {probe_vec(rays, i), probe_vec(rays + 3, i)};
    return ray;
}

/* How many faces each ray hits: each face asked as a scene of its own. A work-item per ray. */
kernel void probe_counts(constant Parameters *parameters, global const FaceRecord *faces, global const real *face_rows,
                         global const wide *planes, global const wide *rays, global int *counts)
{
    int i = (int)get_global_id(0), count = 0;
    if (i >= parameters->ray_count)
        return;
    uint counters[COUNTER_KINDS] = {0};
    for (int face = 0; face < parameters->face_count; face++) {
        global const real *its_rows = face_rows + face * FACE_REALS;
        global const wide *its_planes = planes + face * PLANE_REALS;
        World world = {parameters, faces + face, its_rows, its_planes, 1, 0, 0, 0, 0, 0, i, counters};
        Ray ray = probe_ray(rays, i);
        Hit hit = find_nearest_from_point(&world, &ray, (Mask)-1);
        count += ANY(IS(hit.face >= (Mask)0));
    }
    counts[i] = count;
}

/* Is the segment blocked by a face other than the one it leaves? A work-item per segment. */
kernel void probe_blocked(constant Parameters *parameters, global const FaceRecord *faces, global const real *face_rows,
                          global const wide *planes, global const wide *segments,
                          global const int *left, global int *blocked)
{
    int i = (int)get_global_id(0);
    if (i >= parameters->ray_count)
        return;
    uint counters[COUNTER_KINDS] = {0};
    World world = {parameters, faces, face_rows, planes, parameters->face_count, 0, 0, 0, 0, 0, i, counters};
    wide target[3] = {segments[6 * i + 3], segments[6 * i + 4], segments[6 * i + 5]};
    OriginPacket packets[PACKETS];
    LazyPoints points;
    Nearest nearest[PACKETS]; /* not asked for: the points are ready */
    Mask asking[PACKETS], found[PACKETS];
    begin_points(&world, &points, 0, nearest, asking, false);
    EACH_PACKET(p) {
        points.ready[p] = (Mask)-1;
        points.shifted[p] = probe_vec(segments, i);
        asking[p] = p == 0 ? (Mask)-1 : (Mask)0;
        packets[p].from = (Mask)left[i];
        aim_from_light(packets + p, target, points.shifted[p]);
    }
    Mask near_ties[PACKETS]; /* nothing is left out */
    EACH_PACKET(p)
        near_ties[p] = (Mask)-1;
    ShadowGroup group = {target, packets, &points, found};
    find_blocked(&world, &group, asking, near_ties, 0);
    blocked[i] = ANY(found[0]);
}

/* Where the nearest hit is, and where the next ray starts. A work-item per ray. */
kernel void probe_points(constant Parameters *parameters, global const FaceRecord *faces, global const real *face_rows,
                         global const wide *planes, global const real *materials, global const real *lights,
                         global const real *view, global const wide *rays, global int *hits, global wide *t,
                         global wide *points)
{
    int i = (int)get_global_id(0);
    if (i >= parameters->ray_count)
        return;
    uint counters[COUNTER_KINDS] = {0};
    World world = {parameters, faces, face_rows, planes, parameters->face_count, 0, 0, 0, 0, 0, i, counters};
    Ray ray = probe_ray(rays, i);
    Hit hit = find_nearest_from_point(&world, &ray, (Mask)-1);
    MaskElement face[LANES];
    wide parameter[LANES];
    STORE(hit.face, face);
    STORE(hit.t, parameter);
    hits[i] = (int)face[0];
    t[i] = parameter[0];
    if (face[0] < 0)
        return;
    Nearest nearest = nothing_yet();
    nearest.face = hit.face;
    nearest.from_behind = hit.from_behind;
    Mask active = (Mask)-1;
    LazyPoints lazy;
    begin_points(&world, &lazy, &ray, &nearest, &active, true);
    need_points(&lazy, 0, active);
    WideVec point = lazy.point[0], shifted = lazy.shifted[0];
    Wide numbers[6] = {point.x, point.y, point.z, shifted.x, shifted.y, shifted.z};
    for (int k = 0; k < 6; k++) {
        wide number[LANES];
        STORE(numbers[k], number);
        points[6 * i + k] = number[0];
    }
}

/* The colour that a ray brings, not clamped. A work-item per ray. */
kernel void probe_colours(constant Parameters *parameters, global const FaceRecord *faces, global const real *face_rows,
                          global const wide *planes, global const real *materials, global const real *lights,
                          global const real *view, global const wide *rays, global real *colours)
{
    int i = (int)get_global_id(0);
    if (i >= parameters->ray_count)
        return;
    uint counters[COUNTER_KINDS] = {0};
    World world = {parameters, faces, face_rows, planes, parameters->face_count, materials, lights, view, 0, 0, i,
                   counters};
    Path paths[PACKETS];
    Ray rays_of[PACKETS];
    EACH_PACKET(p) {
        rays_of[p] = probe_ray(rays, i);
        paths[p].active = p == 0 ? (Mask)-1 : (Mask)0;
    }
    wide eye[3] = {rays[6 * i], rays[6 * i + 1], rays[6 * i + 2]};
    real length = 0;
    for (int k = 3; k < 6; k++)
        length += (real)fabs(rays[6 * i + k]);
    Apex apex = apex_at(eye, 0, length * (1 + 4 * REAL_ROUNDING));
    OriginPacket packets[PACKETS];
    EACH_PACKET(p) {
        packets[p].active = paths[p].active;
        packets[p].ahead = vec_to_real(rays_of[p].direction);
    }
    RayBounds seen = bounds_from(&apex, packets, PACKETS, 0);
    begin_paths(paths, rays_of);
    Eye from = {eye, &apex, &seen};
    trace_paths(&world, &from, 0, paths, rays_of, 0, 0);
    Vec colour = paths[0].total;
    Lanes numbers[3] = {colour.x, colour.y, colour.z};
    for (int k = 0; k < 3; k++) {
        real number[LANES];
        STORE(numbers[k], number);
        colours[3 * i + k] = number[0];
    }
}

/* Powers of pairs of numbers. A work-item per pair. */
kernel void probe_powers(constant Parameters *parameters, global const wide *pairs, global real *powers)
{
    int i = (int)get_global_id(0);
    if (i >= parameters->ray_count)
        return;
    real number[LANES];
    STORE(power((Lanes)(real)pairs[2 * i], (real)pairs[2 * i + 1]), number);
    powers[i] = number[0];
}
