/* Beams against faces, for adaptive sampling: all rays of a pixel at once, each lane of each packet another pixel. What
 * src/trace/beam.c and src/trace/beam_query.c say, with the same operations in the same order. The pixels of a group
 * see the same faces in the same order, so that their beams share all but the middle direction c, and nearly all that
 * is asked of a face is scalar. */
#include "shared/compiler.cl"
#include "shared/layout.h"
#include "shared/precision.cl"
#include "packet/faces.cl"
#include "packet/lanes.cl"
#include "packet/planes.cl"
#include "packet/vectors.cl"
#include "packet/world.cl"

/* Relative to the magnitudes in a value, more than all rounding: of what is computed in wide; what real adds to it. */
#if REAL_DOUBLE || HAS_DOUBLE
#define WIDE_SLACK 0x1p-38
#else
#define WIDE_SLACK 0x1p-12f
#endif
#if REAL_DOUBLE
#define REAL_SLACK (real)0
#define BOX_SLACK (real)0x1p-36
#else
#define REAL_SLACK (real)0x1p-20f
#define BOX_SLACK (real)0x1p-18f
#endif

#if REAL_DOUBLE
#define TO_INT8(m) convert_int8(m)
#else
#define TO_INT8(m) (m)
#endif

typedef struct Point {
    wide x, y, z;
} Point;

INLINE Point point(wide x, wide y, wide z)
{
    Point p = {x, y, z};
    return p;
}

INLINE Point point_add(Point a, Point b) { return point(a.x + b.x, a.y + b.y, a.z + b.z); }
INLINE Point point_sub(Point a, Point b) { return point(a.x - b.x, a.y - b.y, a.z - b.z); }
INLINE Point point_scale(wide s, Point a) { return point(s * a.x, s * a.y, s * a.z); }
INLINE wide point_dot(Point a, Point b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
INLINE wide point_magnitudes(Point a) { return fabs(a.x) + fabs(a.y) + fabs(a.z); }

INLINE Point point_cross(Point a, Point b)
{
    return point(a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x);
}

INLINE Point face_point(const World *world, int face, int k)
{
    global const real *v = face_row(world, face) + k;
    return point((wide)v[0], (wide)v[4], (wide)v[8]);
}

INLINE Point face_normal(const World *world, int face)
{
    PlaneRow plane = plane_row(world, face);
    return point(plane.x, plane.y, plane.z);
}

INLINE int face_vertex_count(const World *world, int face)
{
    return face_bits(face_row(world, face)) & FACE_TRIANGLE ? 3 : 4;
}

/* --- Making beams --- */

/* What is each pixel's own. */
typedef struct BeamLanes {
    WideVec c;
    Vec real_c;
    Lanes length;      /* as in beam.h */
    Lanes real_length; /* of the direction alone, as it is */
} BeamLanes;

typedef struct Beam {
    Point apex, u, v;
    Point c0;                  /* the c of one of the group's pixels, */
    wide middle[2], extent[2]; /* and where the others' beams are in u and v from there: between middle -+ half */
    wide size, width, length; /* length: no less than that of each lane */
    bool mirrored;
    BeamLanes lanes[PACKETS];
} Beam;

INLINE Wide wide_times(Point w, WideVec d) { return (Wide)w.x * d.x + (Wide)w.y * d.y + (Wide)w.z * d.z; }

INLINE WideVec wide_point(Point p) { return wide_vec((Wide)p.x, (Wide)p.y, (Wide)p.z); }

INLINE void beam_bounds(Beam *b)
{
    b->width = point_magnitudes(b->u) + point_magnitudes(b->v);
    b->length = point_magnitudes(b->c0) + 2 * (b->extent[0] + b->extent[1]) * b->width;
    EACH_PACKET(k) {
        BeamLanes *lanes = b->lanes + k;
        lanes->real_c = vec_to_real(lanes->c);
        lanes->length = lanes->real_length = TO_REAL(wide_magnitudes(lanes->c) + b->width);
    }
}

INLINE Point point_mirrored(Point d, Point n) { return point_sub(d, point_scale(2 * point_dot(d, n), n)); }

static void beam_mirror(const World *world, Beam *beam, int face)
{
    Point n = face_normal(world, face), corner = face_point(world, face, 0);
    wide height = point_dot(n, point_sub(beam->apex, corner));
    beam->apex = point_sub(beam->apex, point_scale(2 * height, n));
    beam->u = point_mirrored(beam->u, n);
    beam->v = point_mirrored(beam->v, n);
    beam->c0 = point_mirrored(beam->c0, n);
    EACH_PACKET(k) {
        WideVec c = beam->lanes[k].c;
        beam->lanes[k].c = wide_sub(c, wide_scale(2 * wide_times(n, c), wide_point(n)));
    }
    wide size = point_magnitudes(beam->apex) + point_magnitudes(corner);
    beam->size = beam->size > size ? beam->size : size;
    beam->mirrored = true;
    beam_bounds(beam);
}

NOINLINE void beam_from_point(const World *world, const Beam *beam, int face, Point x, Beam *b)
{
    Point to_vertex = point_sub(beam->apex, face_point(world, face, 0)), from_x = point_sub(beam->apex, x);
    Point n = face_normal(world, face);
    wide height = point_dot(n, to_vertex);
    if (height < 0)
        n = point(-n.x, -n.y, -n.z);
    height = fabs(height);
    wide grown = point_magnitudes(from_x) + point_magnitudes(to_vertex) + beam->size + point_magnitudes(x);
    b->apex = x;
    b->u = point_add(point_scale(-point_dot(n, beam->u), from_x), point_scale(height, beam->u));
    b->v = point_add(point_scale(-point_dot(n, beam->v), from_x), point_scale(height, beam->v));
    b->c0 = point_add(point_scale(-point_dot(n, beam->c0), from_x), point_scale(height, beam->c0));
    for (int i = 0; i < 2; i++) {
        b->middle[i] = beam->middle[i];
        b->extent[i] = beam->extent[i];
    }
    b->size = point_magnitudes(x);
    b->width = grown * beam->width;
    wide sides = point_magnitudes(b->u) + point_magnitudes(b->v);
    b->length = grown * beam->length;
    b->mirrored = false;
    EACH_PACKET(k) {
        WideVec c = beam->lanes[k].c;
        b->lanes[k].c = wide_add(wide_scale(-wide_times(n, c), wide_point(from_x)), wide_scale((Wide)height, c));
        b->lanes[k].real_c = vec_to_real(b->lanes[k].c);
        b->lanes[k].length = (real)grown * beam->lanes[k].length;
        b->lanes[k].real_length = TO_REAL(wide_magnitudes(b->lanes[k].c) + sides);
    }
}

/* --- Linear functions of the direction --- */

/* w.d over a beam: between w.c -+ extent, and in doubt by `doubt` for each unit of a lane's length, and by `rounding`,
 * that to real, for each unit of its direction. */
typedef struct Linear {
    real x, y, z;
    real extent, doubt, rounding;
} Linear;

/* Where w is known but for `error`. */
INLINE Linear linear_over(const Beam *b, Point w, wide error)
{
    Linear f = {(real)w.x, (real)w.y, (real)w.z, (real)(fabs(point_dot(w, b->u)) + fabs(point_dot(w, b->v))),
                (real)error, (real)(REAL_SLACK * point_magnitudes(w))};
    return f;
}

INLINE Lanes along_c(const BeamLanes *b, const Linear *f)
{
    return f->x * b->real_c.x + f->y * b->real_c.y + f->z * b->real_c.z;
}

INLINE Lanes doubt_of(const BeamLanes *b, const Linear *f)
{
    return f->doubt * b->length + f->rounding * b->real_length;
}

typedef struct BeamPlane {
    Point q;
    wide error;
    int side;
} BeamPlane;

NOINLINE BeamPlane beam_plane(const World *world, const Beam *beam, int face)
{
    Point n = face_normal(world, face), x = point_sub(beam->apex, face_point(world, face, 0));
    wide height = point_dot(n, x), doubt = WIDE_SLACK * (beam->size + point_magnitudes(x));
    BeamPlane plane = {{0, 0, 0}, WIDE_MAX, 0};
    if (fabs(height) <= doubt) {
        wide apex[3] = {beam->apex.x, beam->apex.y, beam->apex.z};
        wide distance = beam->mirrored ? 0 : plane_distance_of_point(world, face, apex);
        plane.side = distance > 0 ? 1 : distance < 0 ? -1 : 0;
        return plane;
    }
    plane.q = point_scale(1 / height, n);
    plane.error = point_magnitudes(plane.q) * (WIDE_SLACK + doubt / fabs(height));
    plane.side = height > 0 ? 1 : -1;
    return plane;
}

/* Tells by negative values for which pixels plane b is farther along all of the beam than plane a; false: for none. */
INLINE bool farther_plane(const Beam *beam, const BeamPlane *a, const BeamPlane *b, Linear *f)
{
    if (a->error == WIDE_MAX || b->error == WIDE_MAX)
        return false;
    *f = linear_over(beam, point_sub(a->q, b->q), a->error + b->error);
    return true;
}

INLINE Mask is_negative(const BeamLanes *b, const Linear *f)
{
    return IS(along_c(b, f) + f->extent < -doubt_of(b, f));
}

/* --- Edges --- */

/* A face as a beam sees it. */
typedef struct BeamFace {
    int face, count, side;
    Linear edges[4];
    /* On which sides of a pixel's four the corners are: l -+ across, l -+ down, but for their doubt. Found on
     * demand. */
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
        wide error = WIDE_SLACK * (b->size + point_magnitudes(p));
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
        wide error = WIDE_SLACK * (b->size + point_magnitudes(p));
        f->l[k] = sign * (real)point_dot(uv, p);
        Linear across = {sign * (real)pv.x, sign * (real)pv.y, sign * (real)pv.z, 0,
                         (real)(error * b->width), REAL_SLACK * (real)(point_magnitudes(pv) + point_magnitudes(up))};
        Linear down = {sign * (real)up.x, sign * (real)up.y, sign * (real)up.z, 0, across.doubt, across.rounding};
        f->across[k] = across;
        f->down[k] = down;
    }
}

typedef struct BeamCover {
    Mask clear, filled;
} BeamCover;

/* Beyond the beam's sides a = -+1, told by l a at the corners, or b = -+1: see is_beyond in beam.c. */
INLINE Mask is_beyond(const BeamLanes *b, const BeamFace *f, const Linear *coordinate, bool reaches_behind)
{
    Mask beyond[2] = {(Mask)-1, (Mask)-1};
    Lanes low[2] = {(Lanes)0, (Lanes)0}, high[2] = {(Lanes)(real)INFINITY, (Lanes)(real)INFINITY};
    for (int k = 0; k < f->count; k++) {
        Lanes x = along_c(b, coordinate + k), doubt = doubt_of(b, f->across + k), forward = f->l[k] + doubt;
        for (int side = 0; side < 2; side++) {
            Lanes outward = (side ? -x : x) - doubt;
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
        Lanes middle = along_c(b, edge), doubt = doubt_of(b, edge);
        Mask left = IS(middle - edge->extent > doubt), right = IS(middle + edge->extent < -doubt);
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
