/* The two questions that a ray asks a scene: which face is nearest, and is anything between here and the light. */

typedef struct Counters {
    uint kinds[COUNTER_KINDS];
} Counters;

typedef struct Nearest {
    Wide t;
    Mask face;        /* -1: none */
    Mask with_normal; /* N.R > 0: the ray came from behind the normal */
} Nearest;

/* The nearest face in front of each active lane, leaving out the face that it leaves; of equal t the first in the file. */
static Nearest find_nearest(const Geometry *g, Vec origin, Vec direction, Mask active, Mask left, Counters *counters)
{
    Nearest nearest = {(Wide)WIDE_MAX, (Mask)-1, (Mask)0};
    Line l = line(origin, direction);
    WideVec o = vec_to_wide(origin), r = vec_to_wide(direction);
    for (int i = 0; i < g->face_count; i++) {
        EdgeTest edges = test_edges(&l, g->edges + (size_t)i * FACE_REALS);
        edges.may &= active & IS(left != (Mask)i);
        if (!ANY(edges.may))
            continue;
        if (ANY(edges.may & ~edges.sure))
            settle_edges(&edges, g->faces + i, &l, 0);
        if (g->faces[i].front_only)
            edges.may &= ~edges.with_normal;

        PlaneRow plane = plane_row(g, i);
        WideMask with_normal = TO_WIDE_MASK(edges.with_normal);
        Wide distance = plane_distance(g, i, plane, o, TO_WIDE_MASK(edges.may));
        Wide approach = plane.x * r.x + plane.y * r.y + plane.z * r.z;
        /* The edges have told the exact sign of N.R. */
        approach = with_normal ? (approach > (Wide)0 ? approach : (Wide)WIDE_MIN)
                               : (approach < (Wide)0 ? approach : (Wide)-WIDE_MIN);
        Wide t = -distance / approach;
        WideMask ahead = with_normal ? IS(distance < (Wide)0) : IS(distance > (Wide)0);
        WideMask nearer = TO_WIDE_MASK(edges.may) & ahead & IS(t <= (Wide)WIDE_MAX) & IS(t < nearest.t);
        Mask take = TO_MASK(nearer);
        nearest.t = nearer ? t : nearest.t;
        nearest.face = take ? (Mask)i : nearest.face;
        nearest.with_normal = take ? edges.with_normal : nearest.with_normal;
    }
    counters->kinds[COUNT_FACE_TESTS] += mask_count(active) * (uint)g->face_count;
    return nearest;
}

/* The active lanes whose segment from `origin` to `target` is blocked by a face strictly between the two. */
static Mask find_blocked(const Geometry *g, Vec origin, const wide *target, Mask active, Mask left, Counters *counters)
{
    WideVec o = vec_to_wide(origin);
    WideVec to_target = {target[0] - o.x, target[1] - o.y, target[2] - o.z};
    Line l = line(origin, vec_to_real(to_target));
    Mask blocked = (Mask)0;
    int i = 0;
    for (; i < g->face_count && ANY(active); i++) {
        EdgeTest edges = test_edges(&l, g->edges + (size_t)i * FACE_REALS);
        edges.may &= active & IS(left != (Mask)i);
        if (!ANY(edges.may))
            continue;
        if (ANY(edges.may & ~edges.sure))
            settle_edges(&edges, g->faces + i, &l, target);
        PlaneRow plane = plane_row(g, i);
        wide end = plane_distance_of_point(g, i, plane, target);
        Wide start = plane_distance(g, i, plane, o, TO_WIDE_MASK(edges.may));
        WideMask before = IS(start > (Wide)0), behind = IS(start < (Wide)0);
        WideMask between = end < 0 ? before : end > 0 && !g->faces[i].front_only ? behind : (WideMask)0;
        Mask hit = edges.may & TO_MASK(between);
        blocked |= hit;
        active &= ~hit;
    }
    counters->kinds[COUNT_FACE_TESTS] += mask_count(active | blocked) * (uint)i;
    return blocked;
}
