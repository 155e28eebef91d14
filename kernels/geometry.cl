/* Faces against lanes of rays. A fast test in `real` with a proved error bound settles nearly every lane;
 * the few that lie within the bound of an edge are settled by exact.cl. docs/algorithm.md derives the bounds. */

typedef struct Geometry {
    global const FaceRecord *faces;
    global const real *edges;  /* face_count rows of FACE_REALS */
    global const real *planes; /* face_count rows of PLANE_REALS */
    int face_count;
} Geometry;

/* What the edge functions need of a ray: s_k = R . moment_k + (O x R) . direction_k = det(R, v[k] - O, v[k+1] - O). */
typedef struct Line {
    Vec origin, direction, moment;
    Lanes direction_bound, moment_bound; /* rounding error per unit of FACE_MOMENT_BOUND, FACE_DIRECTION_BOUND */
} Line;

INLINE Line line(Vec origin, Vec direction)
{
    Line l;
    l.origin = origin;
    l.direction = direction;
    l.moment = vec_cross(origin, direction);
    Lanes largest = vec_largest(direction);
    l.direction_bound = (10 * REAL_ROUNDING) * largest;
    l.moment_bound = (10 * REAL_ROUNDING) * (vec_largest(l.moment) + vec_largest(origin) * largest) + REAL_FLOOR;
    return l;
}

/* Lanes against one face: which may pass inside, which certainly do, and on which side of the normal. */
typedef struct EdgeTest {
    Mask may, sure, with_normal;
} EdgeTest;

INLINE Lanes edge_function(const Line *l, global const real *edge)
{
    return FMA(l->direction.x, edge[0],
               FMA(l->direction.y, edge[1],
                   FMA(l->direction.z, edge[2],
                       FMA(l->moment.x, edge[3], FMA(l->moment.y, edge[4], l->moment.z * edge[5])))));
}

INLINE EdgeTest test_edges(const Line *l, global const real *row)
{
    Lanes s0 = edge_function(l, row), s1 = edge_function(l, row + EDGE_REALS);
    Lanes s2 = edge_function(l, row + 2 * EDGE_REALS), s3 = edge_function(l, row + 3 * EDGE_REALS);
    Lanes low = LESSER(LESSER(s0, s1), LESSER(s2, s3)), high = GREATER(GREATER(s0, s1), GREATER(s2, s3));
    Lanes bound = FMA(l->direction_bound, row[FACE_MOMENT_BOUND],
                      FMA(l->moment_bound, row[FACE_DIRECTION_BOUND], REAL_FLOOR));
    EdgeTest test;
    test.with_normal = IS(low > bound);
    test.sure = test.with_normal | IS(high < -bound);
    test.may = IS(low >= -bound) | IS(high <= bound);
    return test;
}

/* Settles the lanes that may pass inside but not surely. With `target` the rays are segments that end there. */
NOINLINE void settle_edges(EdgeTest *test, global const FaceRecord *face, const Line *l, const wide *target)
{
    MaskElement may[LANES], sure[LANES], with_normal[LANES];
    real o[3][LANES], r[3][LANES];
    STORE(test->may, may);
    STORE(test->sure, sure);
    STORE(test->with_normal, with_normal);
    STORE(l->origin.x, o[0]);
    STORE(l->origin.y, o[1]);
    STORE(l->origin.z, o[2]);
    STORE(l->direction.x, r[0]);
    STORE(l->direction.y, r[1]);
    STORE(l->direction.z, r[2]);
    for (int i = 0; i < LANES; i++) {
        if (!may[i] || sure[i])
            continue;
        wide origin[3] = {o[0][i], o[1][i], o[2][i]};
        wide zero[3] = {0, 0, 0};
        wide direction[3] = {r[0][i], r[1][i], r[2][i]};
        Exact exact = target ? exact_difference(target, origin) : exact_difference(direction, zero);
        int sign = inside_sign(face, origin, &exact);
        may[i] = sign ? -1 : 0;
        with_normal[i] = sign > 0 ? -1 : 0;
    }
    test->may = LOAD(may);
    test->with_normal = LOAD(with_normal);
}

typedef struct PlaneRow {
    wide x, y, z, error;
} PlaneRow;

INLINE PlaneRow plane_row(const Geometry *g, int face)
{
    global const real *row = g->planes + (size_t)face * PLANE_REALS;
    PlaneRow plane = {(wide)row[0] + (wide)row[3], (wide)row[1] + (wide)row[4], (wide)row[2] + (wide)row[5],
                      (wide)row[PLANE_ERROR] + (sizeof(wide) > sizeof(float) ? 0 : WIDE_ROUNDING)}; /* of the sums */
    return plane;
}

/* The exact signs for the values that lie within their bound. */
NOINLINE Wide settle_distance(global const FaceRecord *record, Wide value, Wide bound, WideVec point)
{
    wide v[LANES], p[3][LANES], b[LANES];
    STORE(value, v);
    STORE(bound, b);
    STORE(point.x, p[0]);
    STORE(point.y, p[1]);
    STORE(point.z, p[2]);
    for (int i = 0; i < LANES; i++)
        if (fabs(v[i]) <= b[i]) {
            wide at[3] = {p[0][i], p[1][i], p[2][i]};
            v[i] = with_sign(v[i], side_sign(record, at));
        }
    return LOAD(v);
}

/* N . (point - v0), its sign exact in every lane of `active`. */
INLINE Wide plane_distance(const Geometry *g, int face, PlaneRow plane, WideVec point, WideMask active)
{
    global const FaceRecord *record = g->faces + face;
    Wide x = point.x - (wide)record->vertices[0];
    Wide y = point.y - (wide)record->vertices[1];
    Wide z = point.z - (wide)record->vertices[2];
    Wide value = plane.x * x + plane.y * y + plane.z * z;
    Wide bound = (plane.error + 4 * WIDE_ROUNDING) * (fabs(x) + fabs(y) + fabs(z));
    WideMask unsure = active & IS(fabs(value) <= bound);
    return ANY(TO_MASK(unsure)) ? settle_distance(record, value, bound, point) : value;
}

/* The same for one point common to all lanes. */
static wide plane_distance_of_point(const Geometry *g, int face, PlaneRow plane, const wide *point)
{
    global const FaceRecord *record = g->faces + face;
    wide x = point[0] - (wide)record->vertices[0];
    wide y = point[1] - (wide)record->vertices[1];
    wide z = point[2] - (wide)record->vertices[2];
    wide value = plane.x * x + plane.y * y + plane.z * z;
    wide bound = (plane.error + 4 * WIDE_ROUNDING) * (fabs(x) + fabs(y) + fabs(z));
    return fabs(value) > bound ? value : with_sign(value, side_sign(record, point));
}

/* The part of each ray from t = enter to t = leave. */
typedef struct Interval {
    Wide enter, leave;
} Interval;

/* Narrows the interval to between two planes across an axis, as interval_between in box.c, bit for bit. */
INLINE void cross_planes(Interval *interval, wide low, wide high, Wide origin, Wide direction)
{
    const wide slack = 8 * WIDE_ROUNDING;
    Wide to_low = (low - origin) / direction, to_high = (high - origin) / direction;
    WideMask along = IS(direction == (Wide)0), forward = IS(direction > (Wide)0);
    WideMask between = IS(origin >= (Wide)low) & IS(origin <= (Wide)high);
    Wide enter = (forward ? to_low : to_high) * (1 - slack), leave = (forward ? to_high : to_low) * (1 + slack);
    enter = along ? (between ? (Wide)0 : (Wide)WIDE_MAX) : enter;
    leave = along ? (between ? (Wide)WIDE_MAX : (Wide)-WIDE_MAX) : leave;
    interval->enter = enter > interval->enter ? enter : interval->enter;
    interval->leave = leave < interval->leave ? leave : interval->leave;
}

/* Where each ray is in the box of the face's vertices. */
static Interval interval_in_box(global const FaceRecord *face, WideVec origin, WideVec direction)
{
    wide low[3], high[3];
    for (int axis = 0; axis < 3; axis++) {
        float a = face->vertices[axis], b = face->vertices[3 + axis], c = face->vertices[6 + axis], d = face->vertices[9 + axis];
        low[axis] = (wide)fmin(fmin(a, b), fmin(c, d));
        high[axis] = (wide)fmax(fmax(a, b), fmax(c, d));
    }
    Interval interval = {(Wide)0, (Wide)WIDE_MAX};
    cross_planes(&interval, low[0], high[0], origin.x, direction.x);
    cross_planes(&interval, low[1], high[1], origin.y, direction.y);
    cross_planes(&interval, low[2], high[2], origin.z, direction.z);
    return interval;
}
