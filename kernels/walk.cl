/* In which order rays ask the faces: all of them, or those in the leaves of the tree that a bundle of rays meets. */

#if ACCEL != ACCEL_NONE

/* How far the bundle still has to look: to the farthest of its rays' nearest hits. */
INLINE real reach_of(const NearestQuery *q)
{
    Wide nearest = q->nearest.t_in_box;
    Lanes t = TO_REAL(nearest < (Wide)REACH_ALL ? nearest : (Wide)REACH_ALL) * q->line.scale;
    return GROWN(highest(t < (Lanes)REACH_ALL ? t : (Lanes)REACH_ALL, q->active));
}

INLINE void walk_nearest(const Geometry *g, const Tree *tree, NearestQuery *q, bool from_eye, Counters *counters)
{
    Bundle b = bundle(&q->line, q->active, from_eye);
    Stack stack = stack_of(tree, &b);
    uint lanes = mask_count(q->active);
    for (int first, count; next_leaf(tree, &b, &stack, &first, &count, counters);) {
        bool nearer = false;
        for (int i = first; i < first + count; i++)
            nearer |= ask_nearest(g, q, face_in_leaf(tree, i));
        counters->kinds[COUNT_FACE_TESTS] += lanes * (uint)count;
        if (nearer)
            b.reach = reach_of(q);
    }
}

INLINE void walk_blocked(const Geometry *g, const Tree *tree, BlockedQuery *q, Counters *counters)
{
    Bundle b = bundle(&q->line, q->active, true);
    b.reach = GROWN(highest(q->line.scale, q->active));
    Stack stack = stack_of(tree, &b);
    for (int first, count; next_leaf(tree, &b, &stack, &first, &count, counters);) {
        counters->kinds[COUNT_FACE_TESTS] += mask_count(q->active) * (uint)count;
        for (int i = first; i < first + count; i++)
            if (ask_blocked(g, q, face_in_leaf(tree, i)) && !ANY(q->active))
                return;
    }
}

/* The active lanes whose direction is like that of the first active one. */
INLINE Mask like_first(const Line *l, Mask active)
{
    Vec d = l->scaled;
    real x[LANES], y[LANES], z[LANES];
    STORE(d.x, x);
    STORE(d.y, y);
    STORE(d.z, z);
    int i = lowest_bit(mask_bits(active));
    const real like = (real)0.25f;
    return active & IS(fabs(d.x - x[i]) <= (Lanes)like) & IS(fabs(d.y - y[i]) <= (Lanes)like) &
           IS(fabs(d.z - z[i]) <= (Lanes)like);
}

#else

INLINE void walk_nearest(const Geometry *g, const Tree *tree, NearestQuery *q, bool from_eye, Counters *counters)
{
    for (int i = 0; i < g->face_count; i++)
        ask_nearest(g, q, i);
    counters->kinds[COUNT_FACE_TESTS] += mask_count(q->active) * (uint)g->face_count;
}

INLINE void walk_blocked(const Geometry *g, const Tree *tree, BlockedQuery *q, Counters *counters)
{
    for (int i = 0; i < g->face_count; i++) {
        counters->kinds[COUNT_FACE_TESTS] += mask_count(q->active);
        if (ask_blocked(g, q, i) && !ANY(q->active))
            return;
    }
}

INLINE Mask like_first(const Line *l, Mask active) { return active; }

#endif

/* The nearest face in front of each active lane, leaving out the face that it leaves; of equal t the first in the file.
 * `from_eye` promises one origin and directions that differ little. */
static Nearest find_nearest(const Geometry *g, const Tree *tree, Ray ray, Mask active, Mask left, bool from_eye,
                            Counters *counters)
{
    NearestQuery q;
    q.ray = ray;
    q.line = line(vec_to_real(ray.origin), vec_to_real(ray.direction));
    q.left = left;
    q.nearest.t = q.nearest.t_in_box = (Wide)WIDE_MAX;
    q.nearest.face = q.nearest.index = (Mask)-1;
    q.nearest.with_normal = (Mask)0;
    for (Mask rest = active; ANY(rest); rest &= ~q.active) {
        q.active = from_eye ? rest : like_first(&q.line, rest);
        walk_nearest(g, tree, &q, from_eye, counters);
    }
    return q.nearest;
}

/* The active lanes whose segment from `origin` to `target` is blocked by a face strictly between the two. */
static Mask find_blocked(const Geometry *g, const Tree *tree, WideVec origin, const wide *target, Mask active, Mask left,
                         Counters *counters)
{
    BlockedQuery q;
    WideVec end = wide_vec((Wide)target[0], (Wide)target[1], (Wide)target[2]);
    q.ray.origin = origin;
    q.ray.direction = wide_sub(end, origin);
    for (int axis = 0; axis < 3; axis++)
        q.target[axis] = target[axis];
    q.line = line(vec_to_real(end), vec_to_real(wide_sub(origin, end)));
    q.left = left;
    q.blocked = (Mask)0;
    for (Mask rest = active; ANY(rest);) {
        q.active = like_first(&q.line, rest);
        rest &= ~q.active;
        walk_blocked(g, tree, &q, counters);
    }
    return q.blocked;
}
