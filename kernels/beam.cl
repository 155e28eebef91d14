/* Beams against faces, for adaptive sampling: all rays of a pixel at once, each lane another pixel. What src/beam.c and
 * src/beam_query.c say, with the same operations in the same order. The pixels of a group see the same faces in the same
 * order, so that their beams share all but the middle direction c, and nearly all that is asked of a face is scalar. */

#if ADAPTIVE

/* Relative to the magnitudes in a value, more than all rounding: of what is computed in wide; what real adds to that. */
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
#define BOX_SLACK (real)0x1p-19f
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

INLINE Point face_point(const Geometry *g, int face, int k)
{
    global const float *v = g->faces[face].vertices + 3 * k;
    return point((wide)v[0], (wide)v[1], (wide)v[2]);
}

INLINE Point face_normal(const Geometry *g, int face)
{
    PlaneRow plane = plane_row(g, face);
    return point(plane.x, plane.y, plane.z);
}

INLINE int face_vertex_count(const Geometry *g, int face)
{
    global const float *v = g->faces[face].vertices;
    return v[0] == v[9] && v[1] == v[10] && v[2] == v[11] ? 3 : 4;
}

/* --- Making beams --- */

typedef struct Beam {
    Point apex, u, v;
    Point c0;                     /* the c of one of the group's pixels, */
    wide middle[2], extent[2];      /* and where the others' beams are in u and v from there: between middle -+ half */
    WideVec c;                    /* each pixel's own */
    Vec real_c;
    Lanes length;
    wide size, width;
    bool mirrored;
} Beam;

INLINE Wide wide_times(Point w, WideVec d) { return (Wide)w.x * d.x + (Wide)w.y * d.y + (Wide)w.z * d.z; }

INLINE WideVec wide_point(Point p) { return wide_vec((Wide)p.x, (Wide)p.y, (Wide)p.z); }

INLINE void beam_bounds(Beam *b)
{
    b->real_c = vec_to_real(b->c);
    b->width = point_magnitudes(b->u) + point_magnitudes(b->v);
    b->length = TO_REAL(wide_magnitudes(b->c) + b->width);
}

INLINE Point point_mirrored(Point d, Point n) { return point_sub(d, point_scale(2 * point_dot(d, n), n)); }

static Beam beam_mirrored(const Geometry *g, const Beam *beam, int face)
{
    Beam m = *beam;
    Point n = face_normal(g, face), corner = face_point(g, face, 0);
    wide height = point_dot(n, point_sub(beam->apex, corner));
    m.apex = point_sub(beam->apex, point_scale(2 * height, n));
    m.u = point_mirrored(beam->u, n);
    m.v = point_mirrored(beam->v, n);
    m.c0 = point_mirrored(beam->c0, n);
    m.c = wide_sub(beam->c, wide_scale(2 * wide_times(n, beam->c), wide_point(n)));
    wide size = point_magnitudes(m.apex) + point_magnitudes(corner);
    m.size = beam->size > size ? beam->size : size;
    m.mirrored = true;
    beam_bounds(&m);
    return m;
}

NOINLINE Beam beam_from_point(const Geometry *g, const Beam *beam, int face, Point x)
{
    Beam b = *beam;
    Point to_vertex = point_sub(beam->apex, face_point(g, face, 0)), from_x = point_sub(beam->apex, x);
    Point n = face_normal(g, face);
    wide height = point_dot(n, to_vertex);
    if (height < 0)
        n = point(-n.x, -n.y, -n.z);
    height = fabs(height);
    wide grown = point_magnitudes(from_x) + point_magnitudes(to_vertex) + beam->size + point_magnitudes(x);
    b.apex = x;
    b.u = point_add(point_scale(-point_dot(n, beam->u), from_x), point_scale(height, beam->u));
    b.v = point_add(point_scale(-point_dot(n, beam->v), from_x), point_scale(height, beam->v));
    b.c0 = point_add(point_scale(-point_dot(n, beam->c0), from_x), point_scale(height, beam->c0));
    b.c = wide_add(wide_scale(-wide_times(n, beam->c), wide_point(from_x)), wide_scale((Wide)height, beam->c));
    b.real_c = vec_to_real(b.c);
    b.size = point_magnitudes(x);
    b.length = (real)grown * beam->length;
    b.width = grown * beam->width;
    b.mirrored = false;
    return b;
}

/* --- Linear functions of the direction --- */

typedef struct Range {
    Lanes low, high;
} Range;

INLINE Lanes along_c(const Beam *b, Point w)
{
    return (real)w.x * b->real_c.x + (real)w.y * b->real_c.y + (real)w.z * b->real_c.z;
}

INLINE Range range_of(const Beam *b, Point w)
{
    Lanes middle = along_c(b, w);
    real extent = (real)(fabs(point_dot(w, b->u)) + fabs(point_dot(w, b->v)));
    Range range = {middle - extent, middle + extent};
    return range;
}

/* The doubt about w.d, where w is known but for `error`. */
INLINE Lanes doubt_of(const Beam *b, Point w, wide error) { return (real)(error + REAL_SLACK * point_magnitudes(w)) * b->length; }

typedef struct BeamPlane {
    Point q;
    wide error;
    int side;
} BeamPlane;

NOINLINE BeamPlane beam_plane(const Geometry *g, const Beam *beam, int face)
{
    Point n = face_normal(g, face), x = point_sub(beam->apex, face_point(g, face, 0));
    wide height = point_dot(n, x), doubt = WIDE_SLACK * (beam->size + point_magnitudes(x));
    BeamPlane plane = {{0, 0, 0}, WIDE_MAX, 0};
    if (fabs(height) <= doubt) {
        wide apex[3] = {beam->apex.x, beam->apex.y, beam->apex.z};
        wide distance = beam->mirrored ? 0 : plane_distance_of_point(g, face, apex);
        plane.side = distance > 0 ? 1 : distance < 0 ? -1 : 0;
        return plane;
    }
    plane.q = point_scale(1 / height, n);
    plane.error = point_magnitudes(plane.q) * (WIDE_SLACK + doubt / fabs(height));
    plane.side = height > 0 ? 1 : -1;
    return plane;
}

/* The lanes for which plane b is farther along all of the beam than plane a. */
INLINE Mask beam_is_farther(const Beam *beam, const BeamPlane *a, const BeamPlane *b)
{
    if (a->error == WIDE_MAX || b->error == WIDE_MAX)
        return (Mask)0;
    Point w = point_sub(a->q, b->q);
    return IS(range_of(beam, w).high < -doubt_of(beam, w, a->error + b->error));
}

/* --- Edges --- */

typedef struct BeamCover {
    Mask clear, filled;
} BeamCover;

INLINE Mask beside(const Geometry *g, const Beam *b, int face, int count)
{
    Point uv = point_cross(b->u, b->v);
    wide sign = point_dot(uv, b->c0) < 0 ? -1 : 1;
    Mask outside[4] = {(Mask)-1, (Mask)-1, (Mask)-1, (Mask)-1};
    for (int k = 0; k < count; k++) {
        Point p = point_sub(face_point(g, face, k), b->apex), pv = point_cross(p, b->v), up = point_cross(b->u, p);
        real l = (real)(sign * point_dot(uv, p));
        Lanes across = (real)sign * along_c(b, pv), down = (real)sign * along_c(b, up);
        wide error = WIDE_SLACK * (b->size + point_magnitudes(p)) * b->width;
        real extra = REAL_SLACK * (real)(point_magnitudes(pv) + point_magnitudes(up));
        Lanes doubt = ((real)error + extra) * b->length;
        outside[0] &= IS(l - across < -doubt);
        outside[1] &= IS(l + across < -doubt);
        outside[2] &= IS(l - down < -doubt);
        outside[3] &= IS(l + down < -doubt);
    }
    return outside[0] | outside[1] | outside[2] | outside[3];
}

NOINLINE BeamCover beam_cover(const Geometry *g, const Beam *b, int face, int side)
{
    Mask some_left = (Mask)0, some_right = (Mask)0, all_left = (Mask)-1, all_right = (Mask)-1;
    int count = face_vertex_count(g, face);
    for (int k = 0; k < count; k++) {
        Point corner = face_point(g, face, k), p = point_sub(corner, b->apex);
        Point e = point_sub(face_point(g, face, k + 1 < count ? k + 1 : 0), corner), m = point_cross(p, e);
        Range range = range_of(b, m);
        Lanes doubt = doubt_of(b, m, WIDE_SLACK * (b->size + point_magnitudes(p)) * point_magnitudes(e));
        Mask left = IS(range.low > doubt), right = IS(range.high < -doubt);
        some_left |= left;
        some_right |= right;
        all_left &= left;
        all_right &= right;
    }
    BeamCover cover;
    cover.filled = side > 0 ? all_right : side < 0 ? all_left : (Mask)0;
    cover.clear = side > 0 ? some_left : side < 0 ? some_right : some_left & some_right;
    if (ANY(~(cover.filled | cover.clear)))
        cover.clear |= ~cover.filled & beside(g, b, face, count);
    return cover;
}

/* --- One face --- */

typedef struct BeamQuery {
    Beam beam;
    int from, to;
    BeamPlane near, far;
    bool shadow;
    Mask active;          /* the lanes not answered yet */
    Mask crossed, filled; /* the answers */
} BeamQuery;

static bool is_on_side(const Geometry *g, int face, int of, int side)
{
    bool off = false;
    Point n = face_normal(g, of), corner = face_point(g, of, 0);
    int count = face_vertex_count(g, face);
    for (int k = 0; k < count; k++) {
        Point x = point_sub(face_point(g, face, k), corner);
        wide height = side * point_dot(n, x), doubt = WIDE_SLACK * point_magnitudes(x);
        if (height < -doubt)
            return false;
        off |= height > doubt;
    }
    return off;
}

static void ask_beam(const Geometry *g, BeamQuery *q, int i)
{
    const Beam *beam = &q->beam;
    if (i == q->from || i == q->to)
        return;
    BeamPlane seen = beam_plane(g, beam, i);
    int back = q->shadow ? 1 : -1;
    if ((seen.side == 0 && !beam->mirrored) || (seen.side == back && g->faces[i].front_only) ||
        (q->to >= 0 && is_on_side(g, i, q->to, -q->far.side)) || (q->from >= 0 && is_on_side(g, i, q->from, q->near.side)))
        return;
    BeamCover cover = beam_cover(g, beam, i, seen.side);
    Mask met = q->active & ~cover.clear;
    if (!ANY(met))
        return;
    met &= ~beam_is_farther(beam, &q->far, &seen);
    if (q->from >= 0)
        met &= ~beam_is_farther(beam, &seen, &q->near);
    q->crossed |= met;
    if (q->shadow) {
        q->filled |= met & cover.filled & beam_is_farther(beam, &seen, &q->far);
        q->active &= ~q->filled;
    } else {
        q->active &= ~q->crossed;
    }
}

/* --- The faces of a tree --- */

#if ACCEL != ACCEL_NONE

/* A plane, on the positive side of which nothing is wanted: w.(x - o) > 0. */
typedef struct Cut {
    real w[3], o[3];
    real magnitude, size;
} Cut;

INLINE Cut cut(Point w, Point o)
{
    Cut c = {{(real)w.x, (real)w.y, (real)w.z}, {(real)o.x, (real)o.y, (real)o.z}, (real)point_magnitudes(w),
             (real)point_magnitudes(o)};
    return c;
}

/* The cuts: the sides of a beam that holds those of all lanes, and a little more than they, so that no box is left out of
 * which a face would not be; and the planes between which faces are wanted. */
typedef struct Cuts {
    Cut cuts[6];
    int count;
} Cuts;

static Cuts cuts_of(const Geometry *g, const BeamQuery *q)
{
    const Beam *b = &q->beam;
    Point u = point_scale(b->extent[0] + (wide)0.0625f, b->u), v = point_scale(b->extent[1] + (wide)0.0625f, b->v);
    Point c = point_add(b->c0, point_add(point_scale(b->middle[0], b->u), point_scale(b->middle[1], b->v)));
    Point uv = point_cross(u, v), vc = point_cross(v, c), cu = point_cross(c, u);
    wide sign = point_dot(uv, c) < 0 ? -1 : 1;
    Cuts cuts;
    cuts.cuts[0] = cut(point_scale(sign, point_sub(vc, uv)), b->apex);
    cuts.cuts[1] = cut(point_scale(-sign, point_add(vc, uv)), b->apex);
    cuts.cuts[2] = cut(point_scale(sign, point_sub(cu, uv)), b->apex);
    cuts.cuts[3] = cut(point_scale(-sign, point_add(cu, uv)), b->apex);
    cuts.count = 4;
#if ACCEL == ACCEL_BVH /* a box of a k-d tree may hold but a part of a face, of which another part may be elsewhere */
    if (q->to >= 0)
        cuts.cuts[cuts.count++] = cut(point_scale(-q->far.side, face_normal(g, q->to)), face_point(g, q->to, 0));
    if (q->from >= 0)
        cuts.cuts[cuts.count++] = cut(point_scale(q->near.side, face_normal(g, q->from)), face_point(g, q->from, 0));
#endif
    return cuts;
}

#endif

#if ACCEL == ACCEL_BVH

/* The boxes, side by side, that no cut leaves out. `planes` holds low x, high x, low y, ... of each. */
INLINE uint boxes_left(const Cuts *cuts, global const float *planes)
{
    Mask left = (Mask)-1;
    for (int i = 0; i < cuts->count; i++) {
        const Cut *c = &cuts->cuts[i];
        Lanes height = (Lanes)0, magnitude = (Lanes)c->size;
        for (int axis = 0; axis < 3; axis++) {
            Lanes low = LOAD_FLOATS(planes + 2 * axis * NODE_WIDTH) - c->o[axis];
            Lanes high = LOAD_FLOATS(planes + (2 * axis + 1) * NODE_WIDTH) - c->o[axis];
            height += c->w[axis] * (c->w[axis] > 0 ? low : high);
            magnitude += GREATER(fabs(low), fabs(high));
        }
        left &= IS(height <= (BOX_SLACK * c->magnitude) * magnitude);
    }
    return mask_bits(left);
}

NOINLINE void walk_beam(const Geometry *g, const Tree *tree, BeamQuery *q, Counters *counters)
{
    Cuts cuts = cuts_of(g, q);
    int stack[STACK_SIZE], count = 0;
    stack[count++] = 0;
    while (count > 0) {
        int node = stack[--count];
        if (node < 0) {
            int first = LEAF_FIRST(node), faces = LEAF_COUNT(node);
            for (int i = first; i < first + faces && ANY(q->active); i++) {
                counters->kinds[COUNT_FACE_TESTS] += mask_count(q->active);
                ask_beam(g, q, i);
            }
            if (!ANY(q->active))
                return;
            continue;
        }
        counters->kinds[COUNT_BOX_TESTS] += NODE_WIDTH;
        global const int *children = tree->ints + (size_t)node * NODE_WIDTH;
        for (int part = 0; part < NODE_WIDTH; part += LANES)
            for (uint met = boxes_left(&cuts, tree->floats + (size_t)node * (6 * NODE_WIDTH) + part); met; met &= met - 1)
                if (children[part + lowest_bit(met)] != NO_CHILD)
                    stack[count++] = children[part + lowest_bit(met)];
    }
}

#elif ACCEL == ACCEL_KDTREE

typedef struct KdBox {
    int node;
    real planes[6]; /* low x, high x, low y, ... */
} KdBox;

static bool box_is_left(const Cuts *cuts, const KdBox *box)
{
    for (int i = 0; i < cuts->count; i++) {
        const Cut *c = &cuts->cuts[i];
        real height = 0, magnitude = c->size;
        for (int axis = 0; axis < 3; axis++) {
            real low = box->planes[2 * axis] - c->o[axis], high = box->planes[2 * axis + 1] - c->o[axis];
            height += c->w[axis] * (c->w[axis] > 0 ? low : high);
            magnitude += GREATER(fabs(low), fabs(high));
        }
        if (height > BOX_SLACK * c->magnitude * magnitude)
            return false;
    }
    return true;
}

NOINLINE void walk_beam(const Geometry *g, const Tree *tree, BeamQuery *q, Counters *counters)
{
    Cuts cuts = cuts_of(g, q);
    KdBox stack[STACK_SIZE];
    int count = 1;
    stack[0].node = 0;
    for (int k = 0; k < 6; k++)
        stack[0].planes[k] = tree->floats[k];
    while (count > 0) {
        KdBox box = stack[--count];
        counters->kinds[COUNT_BOX_TESTS]++;
        if (!box_is_left(&cuts, &box))
            continue;
        global const int *ints = tree->ints + 1 + (size_t)box.node * KD_INTS;
        int axis = ints[KD_AXIS];
        if (axis != KD_LEAF) {
            KdBox below = box, above = box;
            below.node = box.node + 1;
            above.node = ints[KD_FIRST];
            below.planes[2 * axis + 1] = above.planes[2 * axis] = tree->floats[6 + box.node];
            stack[count++] = above;
            stack[count++] = below;
            continue;
        }
        for (int i = ints[KD_FIRST]; i < ints[KD_FIRST] + ints[KD_COUNT] && ANY(q->active); i++) {
            counters->kinds[COUNT_FACE_TESTS] += mask_count(q->active);
            ask_beam(g, q, face_in_leaf(tree, i));
        }
        if (!ANY(q->active))
            return;
    }
}

#else

NOINLINE void walk_beam(const Geometry *g, const Tree *tree, BeamQuery *q, Counters *counters)
{
    for (int i = 0; i < g->face_count && ANY(q->active); i++) {
        counters->kinds[COUNT_FACE_TESTS] += mask_count(q->active);
        ask_beam(g, q, i);
    }
}

#endif
#endif
