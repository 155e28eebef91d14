/* Which faces a beam meets, of all that there are. */
#include "packet/lanes.cl"
#include "packet/geometry.cl"
#include "packet/counters.cl"
#include "packet/shade.cl"
#include "adaptive/group_beam.cl"
#include "adaptive/beam_query.cl"

NOINLINE void traverse_beam(const Geometry *g, const Shading *s, BeamQuery *q, Counters *counters)
{
    GroupBeam whole = group_beam(s, q->beam);
    for (int i = 0; i < g->face_count && q->asking; i++)
        intersect_beam(g, q, &whole, i, counters);
}
