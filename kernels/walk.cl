/* In which order a bundle of rays asks the faces: all of them, or those in the leaves of a tree that the bundle meets.
 * ACCEL (a build option): 0 asks every face, 1 walks a bounding volume hierarchy with NODE_WIDTH children per node.
 * A bundle visits a node when the intervals of its origins and directions allow some ray of it to meet the box
 * (interval traversal: Boulos, Wald, Benthin, "Adaptive Ray Packet Reordering", 2008, section 3). */

typedef struct Tree {
    global const float *boxes; /* per node: 6 planes (low x, high x, low y, ...) of NODE_WIDTH children */
    global const int *children;
} Tree;

#if ACCEL == 1

/* What bounds all rays of a bundle on one axis, the directions scaled to a largest component of 1. */
typedef struct Slab {
    real origin_low, origin_high;
    real inverse_low, inverse_high; /* 1 / the lowest and the highest direction */
    int sign;                       /* of all directions; 0: they differ */
} Slab;

typedef struct Bundle {
    Slab slabs[3];
    Lanes scale; /* t of a lane * scale = distance along the scaled direction */
    real reach;  /* no ray of the bundle goes farther than this */
} Bundle;

#define REACH_ALL ((real)1e30f)
#define GROWN(x) ((x) * (1 + 32 * REAL_ROUNDING)) /* more than the rounding of what follows could take away */

INLINE real lowest(Lanes x, Mask active) { return lanes_lowest(active ? x : (Lanes)REACH_ALL); }
INLINE real highest(Lanes x, Mask active) { return -lowest(-x, active); }

INLINE Slab slab(Lanes origin, Lanes direction, Mask active)
{
    Slab s;
    real low = lowest(direction, active), high = highest(direction, active);
    s.origin_low = lowest(origin, active);
    s.origin_high = highest(origin, active);
    /* They have been rounded to real. */
    s.origin_low -= 2 * REAL_ROUNDING * fabs(s.origin_low);
    s.origin_high += 2 * REAL_ROUNDING * fabs(s.origin_high);
    s.sign = low > 0 ? 1 : high < 0 ? -1 : 0;
    /* Directions that differ in sign, or are 0: those below 0 come from the high plane, those above from the low one. */
    s.inverse_low = s.sign != 0 || low < 0 ? 1 / low : -(real)INFINITY;
    s.inverse_high = s.sign != 0 || high > 0 ? 1 / high : (real)INFINITY;
    return s;
}

INLINE Bundle bundle(const Line *l, Mask active)
{
    Bundle b;
    b.scale = vec_largest(l->direction);
    Lanes shrink = 1 / b.scale;
    b.slabs[0] = slab(l->origin.x, l->direction.x * shrink, active);
    b.slabs[1] = slab(l->origin.y, l->direction.y * shrink, active);
    b.slabs[2] = slab(l->origin.z, l->direction.z * shrink, active);
    b.reach = REACH_ALL;
    return b;
}

/* Narrows [enter, leave] to where the bundle may be between the two planes. 0 * infinity, which is NaN, narrows nothing. */
INLINE void cross_slab(Slab s, Lanes low, Lanes high, Lanes *enter, Lanes *leave)
{
    low -= s.origin_high;
    high -= s.origin_low;
    Lanes near, far = (Lanes)REACH_ALL;
    if (s.sign > 0) {
        near = LESSER(low * s.inverse_low, low * s.inverse_high);
        far = GREATER(high * s.inverse_low, high * s.inverse_high);
    } else if (s.sign < 0) {
        near = LESSER(high * s.inverse_low, high * s.inverse_high);
        far = GREATER(low * s.inverse_low, low * s.inverse_high);
    } else {
        near = GREATER(low * s.inverse_high, high * s.inverse_low);
    }
    *enter = near > *enter ? near : *enter;
    *leave = far < *leave ? far : *leave;
}

/* Nodes to visit, the nearest on top. */
typedef struct Stack {
    int node[STACK_SIZE];
    real enter[STACK_SIZE];
    int count;
} Stack;

INLINE void stack_insert(Stack *stack, int floor, int node, real enter)
{
    int i = stack->count++;
    for (; i > floor && stack->enter[i - 1] < enter; i--) {
        stack->node[i] = stack->node[i - 1];
        stack->enter[i] = stack->enter[i - 1];
    }
    stack->node[i] = node;
    stack->enter[i] = enter;
}

/* Puts the children that the bundle may meet on the stack. */
INLINE void push_children(const Tree *tree, const Bundle *b, int node, Stack *stack)
{
    global const float *boxes = tree->boxes + (size_t)node * (6 * NODE_WIDTH);
    global const int *children = tree->children + (size_t)node * NODE_WIDTH;
    int floor = stack->count;
    for (int part = 0; part < NODE_WIDTH; part += LANES) {
        Lanes enter = (Lanes)0, leave = (Lanes)b->reach;
        for (int axis = 0; axis < 3; axis++)
            cross_slab(b->slabs[axis], LOAD_FLOATS(boxes + 2 * axis * NODE_WIDTH + part),
                       LOAD_FLOATS(boxes + (2 * axis + 1) * NODE_WIDTH + part), &enter, &leave);
        uint met = mask_bits(IS(enter <= GROWN(leave)));
        if (!met)
            continue;
        real enters[LANES];
        STORE(enter, enters);
        for (; met; met &= met - 1) {
            int i = lowest_bit(met);
            if (children[part + i] != NO_CHILD)
                stack_insert(stack, floor, children[part + i], enters[i]);
        }
    }
}

/* The next leaf that the bundle meets, nearest first: its faces are first .. first + count - 1. False: there is none. */
INLINE bool next_leaf(const Tree *tree, const Bundle *b, Stack *stack, int *first, int *count, Counters *counters)
{
    while (stack->count > 0) {
        int node = stack->node[--stack->count];
        if (stack->enter[stack->count] > b->reach)
            continue;
        if (node < 0) {
            *first = LEAF_FIRST(node);
            *count = LEAF_COUNT(node);
            return true;
        }
        counters->kinds[COUNT_BOX_TESTS] += NODE_WIDTH;
        push_children(tree, b, node, stack);
    }
    return false;
}

/* How far the bundle still has to look: to the farthest of its rays' nearest hits. */
INLINE real reach_of(const NearestQuery *q, const Bundle *b)
{
    Wide nearest = q->nearest.t_in_box;
    Lanes t = TO_REAL(nearest < (Wide)REACH_ALL ? nearest : (Wide)REACH_ALL) * b->scale;
    return GROWN(highest(t < (Lanes)REACH_ALL ? t : (Lanes)REACH_ALL, q->active));
}

INLINE void walk_nearest(const Geometry *g, const Tree *tree, NearestQuery *q, Counters *counters)
{
    Bundle b = bundle(&q->line, q->active);
    Stack stack;
    stack.node[0] = 0;
    stack.enter[0] = 0;
    stack.count = 1;
    uint lanes = mask_count(q->active);
    for (int first, count; next_leaf(tree, &b, &stack, &first, &count, counters);) {
        bool nearer = false;
        for (int i = first; i < first + count; i++)
            nearer |= ask_nearest(g, q, i);
        counters->kinds[COUNT_FACE_TESTS] += lanes * (uint)count;
        if (nearer)
            b.reach = reach_of(q, &b);
    }
}

INLINE void walk_blocked(const Geometry *g, const Tree *tree, BlockedQuery *q, Counters *counters)
{
    Bundle b = bundle(&q->line, q->active);
    b.reach = GROWN(highest(b.scale, q->active));
    Stack stack;
    stack.node[0] = 0;
    stack.enter[0] = 0;
    stack.count = 1;
    for (int first, count; next_leaf(tree, &b, &stack, &first, &count, counters);) {
        counters->kinds[COUNT_FACE_TESTS] += mask_count(q->active) * (uint)count;
        for (int i = first; i < first + count; i++)
            if (ask_blocked(g, q, i) && !ANY(q->active))
                return;
    }
}

/* The active lanes whose direction is like that of the first active one. */
INLINE Mask like_first(Vec direction, Mask active)
{
    Vec d = vec_scale(1 / vec_largest(direction), direction);
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

INLINE void walk_nearest(const Geometry *g, const Tree *tree, NearestQuery *q, Counters *counters)
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

INLINE Mask like_first(Vec direction, Mask active) { return active; }

#endif

/* The nearest face in front of each active lane, leaving out the face that it leaves; of equal t the first in the file.
 * `alike` promises that the directions differ little. */
static Nearest find_nearest(const Geometry *g, const Tree *tree, Ray ray, Mask active, Mask left, bool alike,
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
        q.active = alike ? rest : like_first(q.line.direction, rest);
        walk_nearest(g, tree, &q, counters);
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
        q.active = like_first(q.line.direction, rest);
        rest &= ~q.active;
        walk_blocked(g, tree, &q, counters);
    }
    return q.blocked;
}
