/* The two questions that a ray asks a scene: which face is nearest, and is anything between here and the light.
 * Here is what one face answers; in which order faces are asked is the business of walk.cl. */

typedef struct Counters {
    uint kinds[COUNTER_KINDS];
} Counters;

/* The nearest face so far, lane by lane. */
typedef struct Nearest {
    Wide t;
    Wide t_in_box;    /* t, or the nearest t at which the ray is in the face's box; it decides what is nearest */
    Mask face;        /* its place in the device's order, -1: none */
    Mask index;       /* its place in the scene's order, which decides between equal t */
    Mask with_normal; /* N.R > 0: the ray came from behind the normal */
} Nearest;

typedef struct NearestQuery {
    Line line;
    Ray ray;
    Mask active, left; /* left: the face that each ray leaves, not to be hit again */
    Nearest nearest;
} NearestQuery;

/* Segments from many points to one target. Their lines are told the other way round: they start at the target, which they
 * share. */
typedef struct BlockedQuery {
    Line line; /* from the target to the points */
    Ray ray;   /* from the points to the target */
    wide target[3];
    Mask active, left, blocked;
} BlockedQuery;

/* Asks face i; true if it is nearer in some lane. */
static bool ask_nearest(const Geometry *g, NearestQuery *q, int i)
{
    EdgeTest edges = test_edges(&q->line, g->edges + (size_t)i * FACE_REALS);
    edges.may &= q->active & IS(q->left != (Mask)i);
    if (!ANY(edges.may))
        return false;
    if (ANY(edges.may & ~edges.sure))
        settle_edges(&edges, g->faces + i, &q->ray, 0);
    if (g->faces[i].front_only) {
        edges.may &= ~edges.with_normal;
        if (!ANY(edges.may)) /* plane_hit wants a lane that asks */
            return false;
    }

    PlaneHit hit = plane_hit(g, i, &q->ray.origin, &q->ray.direction, TO_WIDE_MASK(edges.may));
    /* The edges have told the sign of N.R. */
    WideMask ahead = TO_WIDE_MASK(edges.with_normal) ? IS(hit.distance < (Wide)0) : IS(hit.distance > (Wide)0);
    Wide t_in_box = hit.t;
    if (!g->faces[i].flat) {
        Interval in_box = interval_in_box(g->faces + i, &q->ray);
        ahead &= IS(in_box.enter <= in_box.leave);
        t_in_box = t_in_box < in_box.enter ? in_box.enter : t_in_box;
        t_in_box = t_in_box > in_box.leave ? in_box.leave : t_in_box;
    }
    Mask index = (Mask)g->faces[i].index;
    WideMask first = IS(t_in_box == q->nearest.t_in_box) & TO_WIDE_MASK(IS(index < q->nearest.index));
    WideMask nearer = TO_WIDE_MASK(edges.may) & ahead & IS(hit.t <= (Wide)WIDE_MAX) &
                      (IS(t_in_box < q->nearest.t_in_box) | first);
    Mask take = TO_MASK(nearer);
    q->nearest.t = nearer ? hit.t : q->nearest.t;
    q->nearest.t_in_box = nearer ? t_in_box : q->nearest.t_in_box;
    q->nearest.face = take ? (Mask)i : q->nearest.face;
    q->nearest.index = take ? index : q->nearest.index;
    q->nearest.with_normal = take ? edges.with_normal : q->nearest.with_normal;
    return ANY(take);
}

/* Asks face i; true if it blocks some lane. Blocked lanes are asked no more. */
static bool ask_blocked(const Geometry *g, BlockedQuery *q, int i)
{
    EdgeTest edges = test_edges(&q->line, g->edges + (size_t)i * FACE_REALS);
    edges.may &= q->active & IS(q->left != (Mask)i);
    if (!ANY(edges.may))
        return false;
    if (ANY(edges.may & ~edges.sure))
        settle_edges(&edges, g->faces + i, &q->ray, q->target);
    PlaneRow plane = plane_row(g, i);
    wide end = plane_distance_of_point(g, i, q->target);
    Wide start = plane_distance(g, i, &plane, q->ray.origin, TO_WIDE_MASK(edges.may));
    WideMask before = IS(start > (Wide)0), behind = IS(start < (Wide)0);
    WideMask between = end < 0 ? before : end > 0 && !g->faces[i].front_only ? behind : (WideMask)0;
    if (!g->faces[i].flat) {
        Interval in_box = interval_in_box(g->faces + i, &q->ray);
        between &= IS(in_box.enter <= in_box.leave) & IS(in_box.enter <= (Wide)1);
    }
    Mask hit = edges.may & TO_MASK(between);
    q->blocked |= hit;
    q->active &= ~hit;
    return ANY(hit);
}
