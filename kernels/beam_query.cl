/* Which faces a beam meets on its way: all are asked, or those of a tree. What src/beam_query.c says, for all beams of a group at
 * once. */

#if ADAPTIVE

/* --- One face --- */

typedef struct BeamQuery {
    const Beam *beam;
    int from, to;
    BeamPlane near, far;
    bool shadow;
    Mask active[PACKETS];                   /* the lanes not answered yet, */
    uint asking;                            /* and how many they are */
    Mask crossed[PACKETS], filled[PACKETS]; /* the answers */
} BeamQuery;

INLINE void count_asking(BeamQuery *q)
{
    q->asking = 0;
    EACH_PACKET(k)
        q->asking += mask_count(q->active[k]);
}

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
    const Beam *beam = q->beam;
    if (i == q->from || i == q->to)
        return;
    BeamPlane seen = beam_plane(g, beam, i);
    int back = q->shadow ? 1 : -1;
    if ((seen.side == 0 && !beam->mirrored) || (seen.side == back && g->faces[i].front_only) ||
        (q->to >= 0 && is_on_side(g, i, q->to, -q->far.side)) || (q->from >= 0 && is_on_side(g, i, q->from, q->near.side)))
        return;
    BeamFace face;
    beam_edges(g, beam, i, seen.side, &face);
    Linear behind, before, within;
    bool has_behind = farther_plane(beam, &q->far, &seen, &behind);
    bool has_before = q->from >= 0 && farther_plane(beam, &seen, &q->near, &before);
    bool has_within = q->shadow && farther_plane(beam, &seen, &q->far, &within);
    EACH_PACKET(k) {
        const BeamLanes *lanes = beam->lanes + k;
        if (!ANY(q->active[k]))
            continue;
        BeamCover cover = beam_cover(g, beam, k, &face, q->active[k]);
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
    count_asking(q);
}

/* --- The faces of a tree --- */

#if ACCEL != ACCEL_NONE

/* Planes, on the positive side of which nothing is wanted: w.(x - o) > 0. They are the sides of a beam that holds those of all
 * lanes, and a little more than they, so that no box is left out of which a face would not be; and the planes between which
 * faces are wanted. What is not used is 0, which leaves nothing out. */
enum { CUTS_MAX = 8 };
typedef struct Cuts {
    real w[3][CUTS_MAX], o[3][CUTS_MAX];
    real slack[CUTS_MAX], size[CUTS_MAX];
    int count;
} Cuts;

/* slack: how far off w.x may be, for each unit of |x - o|1 + size. */
INLINE void add_cut(Cuts *cuts, Point w, Point o, wide slack, wide size)
{
    int i = cuts->count++;
    cuts->w[0][i] = (real)w.x;
    cuts->w[1][i] = (real)w.y;
    cuts->w[2][i] = (real)w.z;
    cuts->o[0][i] = (real)o.x;
    cuts->o[1][i] = (real)o.y;
    cuts->o[2][i] = (real)o.z;
    cuts->slack[i] = BOX_SLACK * (real)slack;
    cuts->size[i] = (real)size;
}

/* What is on the positive side of a face's plane. */
INLINE void cut_plane(Cuts *cuts, const Geometry *g, int face, int side)
{
    Point n = point_scale(side, face_normal(g, face)), corner = face_point(g, face, 0);
    add_cut(cuts, n, corner, point_magnitudes(n), point_magnitudes(corner));
}

/* What is beyond a side of the beam; no less in doubt than where a face is beyond that: see beam_sides. */
INLINE void cut_side(Cuts *cuts, const Beam *b, Point w)
{
    add_cut(cuts, w, b->apex, GREATER(b->extent[0], b->extent[1]) * b->width * b->length, b->size);
}

static void make_cuts(const Geometry *g, const BeamQuery *q, Cuts *cuts)
{
    const Beam *b = q->beam;
    Point u = point_scale(b->extent[0] + (wide)0.0625f, b->u), v = point_scale(b->extent[1] + (wide)0.0625f, b->v);
    Point c = point_add(b->c0, point_add(point_scale(b->middle[0], b->u), point_scale(b->middle[1], b->v)));
    Point uv = point_cross(u, v), vc = point_cross(v, c), cu = point_cross(c, u);
    wide sign = point_dot(uv, c) < 0 ? -1 : 1;
    Cuts none = {{{0}}};
    *cuts = none;
    cut_side(cuts, b, point_scale(sign, point_sub(vc, uv)));
    cut_side(cuts, b, point_scale(-sign, point_add(vc, uv)));
    cut_side(cuts, b, point_scale(sign, point_sub(cu, uv)));
    cut_side(cuts, b, point_scale(-sign, point_add(cu, uv)));
#if ACCEL == ACCEL_BVH /* a box of a k-d tree may hold but a part of a face, of which another part may be elsewhere */
    if (q->to >= 0)
        cut_plane(cuts, g, q->to, -q->far.side);
    if (q->from >= 0)
        cut_plane(cuts, g, q->from, q->near.side);
#endif
}

/* Does no cut leave out the face? All cuts at once. */
INLINE bool face_is_left(const Cuts *cuts, global const float *vertices)
{
    int8 left = (int8)0;
    for (int k = 0; k < 4; k++) {
        real8 height = (real8)0, magnitude = vload8(0, cuts->size);
        for (int axis = 0; axis < 3; axis++) {
            real8 x = (real)vertices[3 * k + axis] - vload8(0, cuts->o[axis]);
            height += vload8(0, cuts->w[axis]) * x;
            magnitude += fabs(x);
        }
        left |= TO_INT8(height <= vload8(0, cuts->slack) * magnitude);
    }
    return all(left);
}

INLINE void ask_if_left(const Geometry *g, BeamQuery *q, const Cuts *cuts, int i, Counters *counters)
{
    if (!face_is_left(cuts, g->faces[i].vertices))
        return;
    counters->kinds[COUNT_FACE_TESTS] += q->asking;
    ask_beam(g, q, i);
}

#endif

#if ACCEL == ACCEL_BVH

/* The boxes, side by side, that no cut leaves out. `planes` holds low x, high x, low y, ... of each. */
INLINE uint boxes_left(const Cuts *cuts, global const float *planes)
{
    Mask left = (Mask)-1;
    for (int i = 0; i < cuts->count; i++) {
        Lanes height = (Lanes)0, magnitude = (Lanes)cuts->size[i];
        for (int axis = 0; axis < 3; axis++) {
            real w = cuts->w[axis][i], o = cuts->o[axis][i];
            Lanes low = LOAD_FLOATS(planes + 2 * axis * NODE_WIDTH) - o;
            Lanes high = LOAD_FLOATS(planes + (2 * axis + 1) * NODE_WIDTH) - o;
            height += w * (w > 0 ? low : high);
            magnitude += GREATER(fabs(low), fabs(high));
        }
        left &= IS(height <= cuts->slack[i] * magnitude);
    }
    return mask_bits(left);
}

NOINLINE void walk_beam(const Geometry *g, const Tree *tree, BeamQuery *q, Counters *counters)
{
    Cuts cuts;
    make_cuts(g, q, &cuts);
    int stack[STACK_SIZE], count = 0;
    stack[count++] = 0;
    while (count > 0) {
        int node = stack[--count];
        if (node < 0) {
            int first = LEAF_FIRST(node), faces = LEAF_COUNT(node);
            for (int i = first; i < first + faces && q->asking; i++)
                ask_if_left(g, q, &cuts, i, counters);
            if (!q->asking)
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
        real height = 0, magnitude = cuts->size[i];
        for (int axis = 0; axis < 3; axis++) {
            real w = cuts->w[axis][i], o = cuts->o[axis][i];
            real low = box->planes[2 * axis] - o, high = box->planes[2 * axis + 1] - o;
            height += w * (w > 0 ? low : high);
            magnitude += GREATER(fabs(low), fabs(high));
        }
        if (height > cuts->slack[i] * magnitude)
            return false;
    }
    return true;
}

NOINLINE void walk_beam(const Geometry *g, const Tree *tree, BeamQuery *q, Counters *counters)
{
    Cuts cuts;
    make_cuts(g, q, &cuts);
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
        for (int i = ints[KD_FIRST]; i < ints[KD_FIRST] + ints[KD_COUNT] && q->asking; i++)
            ask_if_left(g, q, &cuts, face_in_leaf(tree, i), counters);
        if (!q->asking)
            return;
    }
}

#else

NOINLINE void walk_beam(const Geometry *g, const Tree *tree, BeamQuery *q, Counters *counters)
{
    for (int i = 0; i < g->face_count && q->asking; i++) {
        counters->kinds[COUNT_FACE_TESTS] += q->asking;
        ask_beam(g, q, i);
    }
}

#endif
#endif
