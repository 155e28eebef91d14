/* Faces against beams: a face may be clear of a pixel's beam, or fill it.
 *
 *     the beam lies outside of an edge:                        clear
 *     the beam lies inside of all edges:                       filled
 *     all corners of the face lie beyond a side of the beam:   clear */
#include "shared/compiler.cl"
#include "shared/precision.cl"
#include "packet/lanes.cl"
#include "packet/world.cl"
#include "adaptive/beam.cl"
#include "adaptive/linear.cl"
#include "adaptive/point.cl"

/* A face as a beam sees it. */
typedef struct BeamFace {
    int face, count, side;
    Linear edges[4];
    /* On which of the beam's four sides the corners are: l -+ across, l -+ down, but for their errors. Found when they
     * are needed. */
    bool has_sides;
    real l[4];
    Linear across[4], down[4];
} BeamFace;

NOINLINE void beam_edges(const World *world, const Beam *b, int face, int side, BeamFace *f)
{
    f->face = face;
    f->count = face_vertex_count(world, face);
    f->side = side;
    f->has_sides = false;
    for (int k = 0; k < f->count; k++) {
        Point corner = face_point(world, face, k), p = point_sub(corner, b->apex);
        Point e = point_sub(face_point(world, face, k + 1 < f->count ? k + 1 : 0), corner);
        wide error = BEAM_SLACK(b) * (b->size + point_magnitudes(p));
        f->edges[k] = linear_over(b, point_cross(p, e), error * point_magnitudes(e));
    }
}

NOINLINE void beam_sides(const World *world, const Beam *b, BeamFace *f)
{
    Point uv = point_cross(b->u, b->v);
    real sign = point_dot(uv, b->c0) < 0 ? -1 : 1;
    f->has_sides = true;
    for (int k = 0; k < f->count; k++) {
        Point p = point_sub(face_point(world, f->face, k), b->apex);
        Point pv = point_cross(p, b->v), up = point_cross(b->u, p);
        wide error = BEAM_SLACK(b) * (b->size + point_magnitudes(p));
        f->l[k] = sign * (real)point_dot(uv, p);
        Linear across = {sign * (real)pv.x, sign * (real)pv.y, sign * (real)pv.z, 0,
                         (real)(error * b->width), REAL_SLACK * (real)(point_magnitudes(pv) + point_magnitudes(up))};
        Linear down = {sign * (real)up.x, sign * (real)up.y, sign * (real)up.z, 0, across.error, across.rounding};
        f->across[k] = across;
        f->down[k] = down;
    }
}

typedef struct BeamCover {
    Mask clear, filled;
} BeamCover;

/* Do all corners of the face lie beyond one of the beam's sides a = -1 and a = 1, or b? l a at the corners decides; see
 * is_beyond in src/trace/beam.c. */
INLINE Mask is_beyond(const BeamLanes *b, const BeamFace *f, const Linear *coordinate, bool reaches_behind)
{
    Mask beyond[2] = {(Mask)-1, (Mask)-1};
    Lanes low[2] = {(Lanes)0, (Lanes)0}, high[2] = {(Lanes)(real)INFINITY, (Lanes)(real)INFINITY};
    for (int k = 0; k < f->count; k++) {
        Lanes x = along_c(b, coordinate + k), error = linear_error(b, f->across + k), forward = f->l[k] + error;
        for (int side = 0; side < 2; side++) {
            Lanes outward = (side ? -x : x) - error;
            beyond[side] &= IS(forward < (Lanes)0) | IS(outward > forward);
            if (reaches_behind) {
                Lanes m = outward / forward;
                low[side] = forward < (Lanes)0 ? GREATER(m, low[side]) : low[side];
                high[side] = forward < (Lanes)0 ? high[side] : LESSER(m, high[side]);
            }
        }
    }
    return (beyond[0] & IS(low[0] < high[0])) | (beyond[1] & IS(low[1] < high[1]));
}

INLINE Mask beside(const BeamLanes *b, const BeamFace *f)
{
    bool reaches_behind = false;
    for (int k = 0; k < f->count; k++)
        reaches_behind |= f->l[k] < 0;
    return is_beyond(b, f, f->across, reaches_behind) | is_beyond(b, f, f->down, reaches_behind);
}

/* Of packet k of the beam, in the active lanes. */
NOINLINE BeamCover beam_cover(const World *world, const Beam *beam, int packet, BeamFace *f, Mask active)
{
    const BeamLanes *b = beam->lanes + packet;
    Mask some_left = (Mask)0, some_right = (Mask)0, all_left = (Mask)-1, all_right = (Mask)-1;
    for (int k = 0; k < f->count; k++) {
        const Linear *edge = f->edges + k;
        Lanes middle = along_c(b, edge), error = linear_error(b, edge);
        Mask left = IS(middle - edge->extent > error), right = IS(middle + edge->extent < -error);
        some_left |= left;
        some_right |= right;
        all_left &= left;
        all_right &= right;
    }
    BeamCover cover;
    cover.filled = f->side > 0 ? all_right : f->side < 0 ? all_left : (Mask)0;
    cover.clear = f->side > 0 ? some_left : f->side < 0 ? some_right : some_left & some_right;
    if (ANY(active & ~(cover.filled | cover.clear))) {
        if (!f->has_sides)
            beam_sides(world, beam, f);
        cover.clear |= ~cover.filled & beside(b, f);
    }
    return cover;
}
