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

static void ask_beam(const Geometry *g, BeamQuery *q, const WholeBeam *whole, int i, Counters *counters)
{
    const Beam *beam = q->beam;
    if (i == q->from || i == q->to || is_clear_of(g, whole, i))
        return;
    counters->kinds[COUNT_FACE_TESTS] += q->asking;
    BeamPlane seen = beam_plane(g, beam, i);
    int back = q->shadow ? 1 : -1;
    if ((seen.side == 0 && !beam->mirrored) || (seen.side == back && face_bits(face_row(g, i)) & FACE_BACK_OPEN) ||
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

/* Planes, on the positive side of which nothing is wanted: w.x > limit. They are the sides of the whole beam, and the planes
 * between which faces are wanted. */
enum { CUTS_MAX = 6 };
typedef struct Cuts {
    real w[CUTS_MAX][3], limit[CUTS_MAX], slack[CUTS_MAX];
    int lowest[CUTS_MAX][3]; /* which plane of a box has the lowest w.x: of low x, high x, low y, ... */
    int count;
} Cuts;

/* The plane goes through o; slack: how far off w.(x - o) may be, for each unit of |x|1 + size. */
INLINE void add_cut(Cuts *cuts, Point w, Point o, wide slack, wide size)
{
    int i = cuts->count++;
    real_row(w, cuts->w[i]);
    cuts->limit[i] = (real)(point_dot(w, o) + slack * (size + point_magnitudes(o)));
    cuts->slack[i] = (real)slack;
    for (int axis = 0; axis < 3; axis++)
        cuts->lowest[i][axis] = 2 * axis + (cuts->w[i][axis] > 0 ? 0 : 1);
}

/* What is on the positive side of a face's plane. */
INLINE void cut_plane(Cuts *cuts, const Geometry *g, int face, int side)
{
    Point n = point_scale(side, face_normal(g, face)), corner = face_point(g, face, 0);
    add_cut(cuts, n, corner, BOX_SLACK * point_magnitudes(n), point_magnitudes(corner));
}

static void make_cuts(const Geometry *g, const BeamQuery *q, const WholeBeam *b, Cuts *cuts)
{
    Point l = point(b->l[0], b->l[1], b->l[2]);
    cuts->count = 0;
    for (int k = 0; k < 4; k++) {
        const real *across = k < 2 ? b->la : b->lb;
        Point w = point_scale(k % 2 ? -1 : 1, point(across[0], across[1], across[2]));
        add_cut(cuts, point_sub(w, l), q->beam->apex, b->side_slack, q->beam->size);
    }
#if ACCEL == ACCEL_BVH /* a box of a k-d tree may hold but a part of a face, of which another part may be elsewhere */
    if (q->to >= 0)
        cut_plane(cuts, g, q->to, -q->far.side);
    if (q->from >= 0)
        cut_plane(cuts, g, q->from, q->near.side);
#endif
}

#endif

#if ACCEL == ACCEL_BVH

/* The boxes, side by side, that no cut leaves out. `planes` holds low x, high x, low y, ... of each. */
INLINE uint boxes_left(const Cuts *cuts, global const float *planes)
{
    Lanes magnitude = (Lanes)0;
    for (int axis = 0; axis < 3; axis++) {
        Lanes low = LOAD_FLOATS(planes + 2 * axis * NODE_WIDTH), high = LOAD_FLOATS(planes + (2 * axis + 1) * NODE_WIDTH);
        magnitude += GREATER(fabs(low), fabs(high));
    }
    Mask left = (Mask)-1;
    for (int i = 0; i < cuts->count; i++) {
        Lanes height = -FMA(cuts->slack[i], magnitude, cuts->limit[i]);
        for (int axis = 0; axis < 3; axis++)
            height = FMA(cuts->w[i][axis], LOAD_FLOATS(planes + cuts->lowest[i][axis] * NODE_WIDTH), height);
        left &= ~IS(height > (Lanes)0); /* NaN, from overflow, leaves nothing out */
    }
    return mask_bits(left);
}

NOINLINE void walk_beam(const Geometry *g, const Shading *s, BeamQuery *q, Counters *counters)
{
    const Tree *tree = s->tree;
    WholeBeam whole = whole_beam(s, q->beam);
    Cuts cuts;
    make_cuts(g, q, &whole, &cuts);
    int stack[STACK_SIZE], count = 0;
    stack[count++] = 0;
    while (count > 0) {
        int node = stack[--count];
        if (node < 0) {
            int first = LEAF_FIRST(node), faces = LEAF_COUNT(node);
            for (int i = first; i < first + faces && q->asking; i++)
                ask_beam(g, q, &whole, i, counters);
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
    real magnitude = 0;
    for (int axis = 0; axis < 3; axis++)
        magnitude += GREATER(fabs(box->planes[2 * axis]), fabs(box->planes[2 * axis + 1]));
    for (int i = 0; i < cuts->count; i++) {
        real height = -cuts->limit[i] - cuts->slack[i] * magnitude;
        for (int axis = 0; axis < 3; axis++)
            height += cuts->w[i][axis] * box->planes[cuts->lowest[i][axis]];
        if (height > 0)
            return false;
    }
    return true;
}

NOINLINE void walk_beam(const Geometry *g, const Shading *s, BeamQuery *q, Counters *counters)
{
    const Tree *tree = s->tree;
    WholeBeam whole = whole_beam(s, q->beam);
    Cuts cuts;
    make_cuts(g, q, &whole, &cuts);
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
            ask_beam(g, q, &whole, face_in_leaf(tree, i), counters);
        if (!q->asking)
            return;
    }
}

#else

NOINLINE void walk_beam(const Geometry *g, const Shading *s, BeamQuery *q, Counters *counters)
{
    WholeBeam whole = whole_beam(s, q->beam);
    for (int i = 0; i < g->face_count && q->asking; i++)
        ask_beam(g, q, &whole, i, counters);
}

#endif
#endif
