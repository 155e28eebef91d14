/* The kernel `cast`: the nearest faces of a list of rays, LANES of them for each work-item. */
#include "shared/layout.h"
#include "shared/precision.cl"
#include "packet/any_rays.cl"
#include "packet/intersect_exactly.cl"
#include "packet/lanes.cl"
#include "packet/rays.cl"
#include "packet/vectors.cl"
#include "packet/world.cl"

/* rays: ray_count x (origin, direction). hits_face, hits_t: one for each ray; -1 and 0 for a miss. */
NOINLINE void cast_item(const World *world, global const wide *rays, global int *hits_face, global wide *hits_t,
                        volatile global uint *totals)
{
    int first = world->item * LANES, count = min(LANES, world->parameters->ray_count - first);
    if (count <= 0)
        return;
    wide v[6][LANES];
    for (int i = 0; i < LANES; i++)
        for (int k = 0; k < 6; k++)
            v[k][i] = rays[6 * (size_t)(first + min(i, count - 1)) + k];
    Ray ray = {wide_vec(LOAD(v[0]), LOAD(v[1]), LOAD(v[2])), wide_vec(LOAD(v[3]), LOAD(v[4]), LOAD(v[5]))};
    Mask active = IS(lane_numbers() < (Mask)count);
    Hit nearest = ANY(active & ~same_origin(&ray)) ? find_nearest_of_any_rays(world, &ray, active)
                                                   : find_nearest_from_point(world, &ray, active);
    MaskElement face[LANES];
    wide t[LANES];
    STORE(nearest.face, face);
    STORE(nearest.t, t);
    for (int i = 0; i < count; i++) {
        hits_face[first + i] = face[i] < 0 ? -1 : world->faces[face[i]].index;
        hits_t[first + i] = face[i] < 0 ? 0 : t[i];
    }
    world->counters[COUNT_PRIMARY] += (uint)count;
    add_counters(totals, world);
}

kernel FULL_LANES
void cast(constant Parameters *parameters, global const FaceRecord *faces, global const real *face_rows,
          global const wide *planes, global const wide *rays, global int *hits_face, global wide *hits_t,
          volatile global uint *totals,
          global const float *tree_floats, global const int *tree_ints)
{
    uint counters[COUNTER_KINDS] = {0};
    World world = {parameters, faces, face_rows, planes, parameters->face_count, 0, 0, 0, tree_floats, tree_ints,
                   (int)get_global_id(0), counters};
    cast_item(&world, rays, hits_face, hits_t, totals);
}
