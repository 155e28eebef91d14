/* What faces do to the beams of a group: as src/trace/beam_query.c, for all beams of the group at once. From one face
 * to another, or from a light to a face, a face between the two crosses a beam, or fills it, or is clear of it. */
#include "shared/compiler.cl"
#include "shared/layout.h"
#include "shared/precision.cl"
#include "packet/faces.cl"
#include "packet/lanes.cl"
#include "packet/world.cl"
#include "adaptive/beam.cl"
#include "adaptive/beam_face.cl"
#include "adaptive/group_beam.cl"
#include "adaptive/linear.cl"
#include "adaptive/point.cl"

typedef struct BeamQuery {
    const Beam *beam;
    int from, to;
    BeamPlane near, far;
    bool shadow;
    Mask active[PACKETS];                   /* the lanes without an answer yet */
    uint active_count;                      /* so many they are */
    Mask crossed[PACKETS], filled[PACKETS]; /* the answers */
} BeamQuery;

INLINE void count_active(BeamQuery *q)
{
    q->active_count = 0;
    EACH_PACKET(k)
        q->active_count += mask_count(q->active[k]);
}

static bool is_on_side(const World *world, int face, int of, int side)
{
    bool off = false;
    Point n = face_normal(world, of), corner = face_point(world, of, 0);
    int count = face_vertex_count(world, face);
    for (int k = 0; k < count; k++) {
        Point x = point_sub(face_point(world, face, k), corner);
        wide height = side * point_dot(n, x), slack = WIDE_SLACK * point_magnitudes(x);
        if (height < -slack)
            return false;
        off |= height > slack;
    }
    return off;
}

static void intersect_beam(const World *world, BeamQuery *q, const GroupBeam *group, int i)
{
    const Beam *beam = q->beam;
    if (i == q->from || i == q->to || is_clear_of(world, group, i))
        return;
    world->counters[COUNT_FACE_TESTS] += q->active_count;
    BeamPlane seen = beam_plane(world, beam, i);
    int back = q->shadow ? 1 : -1;
    if ((seen.side == 0 && !beam->mirrored) || (seen.side == back && face_bits(face_row(world, i)) & FACE_ONE_SIDED) ||
        (q->to >= 0 && is_on_side(world, i, q->to, -q->far.side)) ||
        (q->from >= 0 && is_on_side(world, i, q->from, q->near.side)))
        return;
    BeamFace face;
    beam_edges(world, beam, i, seen.side, &face);
    Linear behind, before, within;
    bool has_behind = farther_plane(beam, &q->far, &seen, &behind);
    bool has_before = q->from >= 0 && farther_plane(beam, &seen, &q->near, &before);
    bool has_within = q->shadow && farther_plane(beam, &seen, &q->far, &within);
    EACH_PACKET(k) {
        const BeamLanes *lanes = beam->lanes + k;
        if (!ANY(q->active[k]))
            continue;
        BeamCover cover = beam_cover(world, beam, k, &face, q->active[k]);
        Mask met = q->active[k] & ~cover.clear;
        if (!ANY(met))
            continue;
        if (has_behind)
            met &= ~is_negative(lanes, &behind);
        if (has_before)
            met &= ~is_negative(lanes, &before);
        q->crossed[k] |= met;
        if (has_within)
            q->filled[k] |= met & cover.filled & is_negative(lanes, &within);
        q->active[k] &= ~(q->shadow ? q->filled[k] : q->crossed[k]);
    }
    count_active(q);
}
