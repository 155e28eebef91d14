/* Beams without a tree: each face is tested. */
#include "shared/compiler.cl"
#include "packet/world.cl"
#include "adaptive/beam_query.cl"
#include "adaptive/group_beam.cl"

NOINLINE void traverse_beam(const World *world, BeamQuery *q)
{
    GroupBeam group = group_beam(world, q->beam);
    for (int i = 0; i < world->face_count && q->active_count; i++)
        intersect_beam(world, q, &group, i);
}
