/* One beam that holds the beams of a group of pixels. It dismisses nearly all faces and boxes, in `real`, all edges or
 * corners at once: the gallery took 469 ms without it and 277 with it.
 *
 * What it is clear of, each pixel is clear of in the reference, too. For that its slacks are more than all slacks there
 * and all rounding here. In float they are still less than those of a lane's beam. */
#include "shared/compiler.cl"
#include "shared/layout.h"
#include "shared/precision.cl"
#include "packet/apex.cl"
#include "packet/faces.cl"
#include "packet/world.cl"
#include "adaptive/beam.cl"
#include "adaptive/point.cl"

/* A point p, from the apex, is l (c + a u + b v). But for a positive factor, l a, l b and l are linear in p. */
typedef struct GroupBeam {
    real apex[3], size;
    real la[3], lb[3], l[3], side_slack;
    real c[3], u[3], v[3], moment_slack, apex_slack, height_slack;
} GroupBeam;

INLINE void real_row(Point p, real *row)
{
    row[0] = (real)p.x;
    row[1] = (real)p.y;
    row[2] = (real)p.z;
}

static GroupBeam group_beam(const World *world, const Beam *b)
{
    Point u = point_scale(b->extent[0], b->u), v = point_scale(b->extent[1], b->v);
    Point c = point_add(b->c0, point_add(point_scale(b->middle[0], b->u), point_scale(b->middle[1], b->v)));
    Point uv = point_cross(u, v), vc = point_cross(v, c), cu = point_cross(c, u);
    int sign = point_dot(uv, b->c0) < 0 ? -1 : 1;
    wide us = point_magnitudes(u), vs = point_magnitudes(v), cs = point_magnitudes(c),
         crossed = us * vs + vs * cs + cs * us;
    wide farthest = 2 * b->size + world->view[VIEW_FARTHEST];
    GroupBeam group;
    group.size = (real)b->size;
    real_row(b->apex, group.apex);
    real_row(point_scale(sign, vc), group.la);
    real_row(point_scale(sign, cu), group.lb);
    real_row(point_scale(sign, uv), group.l);
    real_row(c, group.c);
    real_row(u, group.u);
    real_row(v, group.v);
    group.side_slack =
        (real)(12 * REAL_ROUNDING * crossed + 4 * BEAM_SLACK(b) * b->extent[0] * b->extent[1] * b->width * b->length);
    group.moment_slack = (real)(16 * REAL_ROUNDING * (cs + us + vs));
    group.apex_slack = 2 * group.size * group.moment_slack + (real)(2 * BEAM_SLACK(b) * farthest * b->length);
    group.height_slack = (real)((8 * REAL_ROUNDING + BEAM_SLACK(b)) * farthest);
    return group;
}

INLINE real4 along_row(const real *row, real4 x, real4 y, real4 z)
{
    return fma((real4)row[0], x, fma((real4)row[1], y, row[2] * z));
}

/* A face's vertices as seen from the apex. */
typedef struct Corners {
    real4 x, y, z;
} Corners;

/* Is the whole beam on the outer side of an edge? */
INLINE bool is_outside(const GroupBeam *b, global const real *row, Corners v)
{
    global const real *n = row + FACE_NORMAL;
    real height = -(n[0] * v.x.x + n[1] * v.y.x + n[2] * v.z.x);
    if (!(fabs(height) > b->height_slack))
        return false;
    EdgeMoments m = edge_moments(row, v.x, v.y, v.z);
    real4 middle = along_row(b->c, m.x, m.y, m.z);
    real4 spread = fabs(along_row(b->u, m.x, m.y, m.z)) + fabs(along_row(b->v, m.x, m.y, m.z));
    real edge = edge_bound(face_bits(row)), size = fabs(v.x.x) + fabs(v.y.x) + fabs(v.z.x) + 2 * edge;
    return any((height > 0 ? middle : -middle) > spread + (b->moment_slack * size + b->apex_slack) * edge);
}

/* Is the whole face beyond one of the beam's sides? */
INLINE bool is_beside(const GroupBeam *b, Corners v)
{
    real4 x = v.x, y = v.y, z = v.z;
    real4 la = along_row(b->la, x, y, z), lb = along_row(b->lb, x, y, z);
    real4 limit = along_row(b->l, x, y, z) + b->side_slack * (fabs(x) + fabs(y) + fabs(z) + b->size);
    return all(la > limit) || all(-la > limit) || all(lb > limit) || all(-lb > limit);
}

INLINE bool is_clear_of(const World *world, const GroupBeam *b, int face)
{
    global const real *row = face_row(world, face);
    Corners v = {of_vertices(row, 0) - b->apex[0], of_vertices(row, 1) - b->apex[1], of_vertices(row, 2) - b->apex[2]};
    return is_outside(b, row, v) || is_beside(b, v);
}
