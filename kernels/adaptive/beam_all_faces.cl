/* Which faces a beam meets, of all that there are. */
#include "shared/compiler.cl"
#include "packet/world.cl"
#include "adaptive/beam_query.cl"
#include "adaptive/group_beam.cl"

NOINLINE void traverse_beam(const World *world, BeamQuery *q)
{
    GroupBeam whole = group_beam(world, q->beam);
    for (int i = 0; i < world->face_count && q->asking; i++)
        intersect_beam(world, q, &whole, i);
}
