/* What the formulas of tracing say. docs/algorithm.md derives each one, docs/bounds.md proves the bounds.
 * A value is computed in double; where it is closer to zero than its rounding error, exact.c decides its sign. */
#include "scene/geometry.h"

#include "scene/exact.h"

#include <float.h>

#define ROUNDING (DBL_EPSILON / 2) /* 2^-53: the relative error of one operation */

View view_of(const Scene *scene)
{
    Vec3 forward = vec3_unit(vec3_sub(scene->camera.look_at, scene->camera.position));
    Vec3 right = vec3_unit(vec3_cross(forward, scene->camera.up));
    return (View){
        .eye = scene->camera.position,
        .forward = vec3_scale(scene->screen.distance, forward),
        .right = right,
        .up = vec3_cross(right, forward),
        .width = scene->screen.width,
        .height = screen_height(&scene->screen),
        .columns = scene->screen.columns,
        .rows = scene->screen.rows,
        .grid = scene->grid,
    };
}

ScreenPoint view_screen_point(const View *view, int column, int row, int i, int j)
{
    return (ScreenPoint){
        .x = ((column + (i + 0.5) / view->grid) / view->columns - 0.5) * view->width,
        .y = (0.5 - (row + (j + 0.5) / view->grid) / view->rows) * view->height,
    };
}

Vec3 view_direction(const View *view, int column, int row, int i, int j)
{
    ScreenPoint at = view_screen_point(view, column, row, i, j);
    return vec3_add(vec3_add(view->forward, vec3_scale(at.x, view->right)), vec3_scale(at.y, view->up));
}

Vec3 face_vertex(const Face *face, int index)
{
    const float *v = face->vertices[index];
    return vec3((double)v[0], (double)v[1], (double)v[2]);
}

Box face_box(const Face *face, const Plane *plane)
{
    Box box = box_empty();
    for (int k = 0; k < 4; k++) {
        const float *v = face->vertices[k];
        box_grow(&box, &(Box){{v[0], v[1], v[2]}, {v[0], v[1], v[2]}});
    }
    /* Across an axis nothing is rounded: t is the same quotient as the box's. */
    for (int axis = 0; axis < 3; axis++)
        if (box.low[axis] == box.high[axis])
            return box;
    double warp = 0; /* how far a vertex may lie from the plane, rounding included */
    for (int k = 0; k < 4; k++) {
        Vec3 edge = vec3_sub(face_vertex(face, k), face_vertex(face, 0));
        double height = vec3_dot(plane->normal, edge);
        warp = fmax(warp, fabs(height) + 8 * ROUNDING * vec3_magnitudes(edge));
    }
    for (int axis = 0; axis < 3; axis++) {
        box.low[axis] = nextafterf((float)((double)box.low[axis] - 256 * warp), -FLT_MAX);
        box.high[axis] = nextafterf((float)((double)box.high[axis] + 256 * warp), FLT_MAX);
    }
    return box;
}

/* a b - c d to twice the precision of a double. */
static Pair difference_of_products(double a, double b, double c, double d)
{
    Pair ab = exact_product(a, b), cd = exact_product(c, d);
    Pair difference = exact_sum(ab.high, -cd.high);
    return exact_sum(difference.high, difference.low + (ab.low - cd.low));
}

static ExactVec3 face_diagonal(const Face *face, int from, int to)
{
    return exact_difference(face_vertex(face, to), face_vertex(face, from));
}

/* The cross product of the diagonals, with an error of 16 u^2 |a| |b| for u = 2^-53. Their low parts are zero unless
 * the exponents of the vertices lie far apart, for a difference of floats mostly fits a double. */
static ExactVec3 diagonals_cross(ExactVec3 a, ExactVec3 b)
{
    Pair x = difference_of_products(a.high.y, b.high.z, a.high.z, b.high.y);
    Pair y = difference_of_products(a.high.z, b.high.x, a.high.x, b.high.z);
    Pair z = difference_of_products(a.high.x, b.high.y, a.high.y, b.high.x);
    Vec3 low = vec3_add(vec3_cross(a.low, b.high), vec3_cross(a.high, b.low));
    x = exact_sum(x.high, x.low + low.x);
    y = exact_sum(y.high, y.low + low.y);
    z = exact_sum(z.high, z.low + low.z);
    return (ExactVec3){vec3(x.high, y.high, z.high), vec3(x.low, y.low, z.low)};
}

/* What rounding took from the quotient of high + low: the remainder of high / divisor is exact with fma. */
static double quotient_low(double quotient, double high, double low, double divisor)
{
    return (fma(-quotient, divisor, high) + low) / divisor;
}

Plane face_plane(const Face *face)
{
    ExactVec3 a = face_diagonal(face, 0, 2), b = face_diagonal(face, 1, 3), m = diagonals_cross(a, b);
    Plane plane = {.length = vec3_length(m.high)};
    double length = plane.length;
    if (!(length > 0))
        return plane;
    Vec3 n = vec3(m.high.x / length, m.high.y / length, m.high.z / length);
    plane.normal = n;
    plane.normal_low = vec3(quotient_low(n.x, m.high.x, m.low.x, length), quotient_low(n.y, m.high.y, m.low.y, length),
                            quotient_low(n.z, m.high.z, m.low.z, length));
    plane.d = -vec3_dot(n, face_vertex(face, 0));
    plane.error = 16 * ROUNDING * ROUNDING * (1 + vec3_length(a.high) * vec3_length(b.high) / length);
    return plane;
}

/* How far arithmetic in twice the precision may be from N.x. */
static double accurate_bound(const Plane *plane, Vec3 x)
{
    return (plane->error + 64 * ROUNDING * ROUNDING) * vec3_magnitudes(x);
}

/* N.x as if computed in twice the precision (Ogita, Rump and Oishi, "Accurate sum and dot product", 2005, algorithm
 * 5.3), and exactly where even that leaves less than 24 bits. The sign is always exact. */
static Pair normal_dot_accurate(const Face *face, const Plane *plane, ExactVec3 x)
{
    Vec3 n = plane->normal;
    Pair xs = exact_product(n.x, x.high.x), ys = exact_product(n.y, x.high.y), zs = exact_product(n.z, x.high.z);
    Pair xy = exact_sum(xs.high, ys.high), xyz = exact_sum(xy.high, zs.high);
    double low =
        xy.low + xyz.low + (xs.low + ys.low + zs.low) + (vec3_dot(plane->normal_low, x.high) + vec3_dot(n, x.low));
    Pair value = exact_sum(xyz.high, low);
    if (fabs(value.high) > 0x1p24 * accurate_bound(plane, x.high))
        return value;
    double exact = exact_determinant(x, face_diagonal(face, 0, 2), face_diagonal(face, 1, 3));
    return (Pair){exact / plane->length, 0};
}

/* Does N.x in plain arithmetic tell the sign? */
static bool plain_is_sure(const Plane *plane, Vec3 x, double value)
{
    return fabs(value) > (plane->error + 8 * ROUNDING) * vec3_magnitudes(x);
}

/* N.x, in plain arithmetic where that tells the sign. */
static double normal_dot(const Face *face, const Plane *plane, ExactVec3 x)
{
    double value = vec3_dot(plane->normal, x.high);
    return plain_is_sure(plane, x.high, value) ? value : normal_dot_accurate(face, plane, x).high;
}

static ExactVec3 from_vertex(const Face *face, Vec3 point)
{
    return exact_difference(point, face_vertex(face, 0));
}

/* N.(point - v0) = N.point + D without the cancellation in D. Most faces are behind the ray or beyond the light, and
 * this is all that is asked of them: the difference without error is taken only where the rounded one is in doubt. */
static double plane_distance(const Face *face, const Plane *plane, Vec3 point)
{
    Vec3 x = vec3_sub(point, face_vertex(face, 0));
    double value = vec3_dot(plane->normal, x);
    return plain_is_sure(plane, x, value) ? value : normal_dot_accurate(face, plane, from_vertex(face, point)).high;
}

/* t of the plane hit with an error of little more than half an
 * ulp, unless the ray grazes the plane at less than 2^-40. */
static double accurate_t(const Face *face, const Plane *plane, Ray ray)
{
    Pair distance = normal_dot_accurate(face, plane, from_vertex(face, ray.origin));
    Pair approach = normal_dot_accurate(face, plane, exact_vec3(ray.direction));
    double q = distance.high / approach.high;
    double rest = fma(-q, approach.high, distance.high) + (distance.low - q * approach.low);
    return -(isfinite(q) ? q + rest / approach.high : q);
}

int plane_side(const Face *face, const Plane *plane, Vec3 point)
{
    double distance = plane_distance(face, plane, point);
    return (distance > 0) - (distance < 0);
}

/* det(R, a - O, b - O), its sign exact. Eight roundings meet in a term of the sum, as in Shewchuk's orient3d
 * (1997, section 4.3); docs/bounds.md counts them. */
static double edge_determinant(Vec3 origin, ExactVec3 r, Vec3 a, Vec3 b)
{
    Vec3 p = vec3_sub(a, origin), q = vec3_sub(b, origin), d = r.high;
    double yz = p.y * q.z, zy = p.z * q.y, zx = p.z * q.x, xz = p.x * q.z, xy = p.x * q.y, yx = p.y * q.x;
    double value = d.x * (yz - zy) + d.y * (zx - xz) + d.z * (xy - yx);
    double magnitude =
        fabs(d.x) * (fabs(yz) + fabs(zy)) + fabs(d.y) * (fabs(zx) + fabs(xz)) + fabs(d.z) * (fabs(xy) + fabs(yx));
    if (fabs(value) > 10 * ROUNDING * magnitude)
        return value;
    return exact_determinant(r, exact_difference(a, origin), exact_difference(b, origin));
}

double point_left_of(Vec3 along, Vec3 from, Vec3 to, Vec3 point)
{
    return edge_determinant(from, exact_vec3(along), to, point);
}

/* The inside test: fills the edges of the test and returns whether every sign says the same side. */
static bool inside_edges(FaceTest *test, const Face *face, Vec3 origin, ExactVec3 r, bool complete)
{
    test->outside_edge = -1;
    for (int k = 0; k < face->vertex_count; k++) {
        Vec3 a = face_vertex(face, k), b = face_vertex(face, (k + 1) % face->vertex_count);
        double determinant = edge_determinant(origin, r, a, b);
        int sign = (determinant > 0) - (determinant < 0);
        test->edge_value[k] = determinant / test->n_dot_r;
        test->edge_sign[k] = test->n_dot_r < 0 ? -sign : sign;
        test->edges = k + 1;
        if (test->edge_sign[k] < 0 && test->outside_edge < 0)
            test->outside_edge = k;
        if (test->outside_edge >= 0 && !complete)
            return false;
    }
    return test->outside_edge < 0;
}

/* A ray that passes inside the edges hits the face unless its box is over before the ray starts. */
static FaceVerdict hit_verdict(FaceTest *test, Interval in_box, double limit)
{
    if (in_box.enter > in_box.leave)
        return FACE_BEHIND;
    test->t_in_box = fmin(fmax(test->t, in_box.enter), in_box.leave);
    return test->t_in_box > limit ? FACE_FARTHER : FACE_INSIDE;
}

FaceTest face_test(const Face *face, const Plane *plane, Ray ray, double limit, bool complete)
{
    FaceTest test = {.outside_edge = -1};
    ExactVec3 r = exact_vec3(ray.direction);
    test.n_dot_r = normal_dot(face, plane, r);
    test.n_dot_o_plus_d = plane_distance(face, plane, ray.origin);

    /* No hit if the ray is parallel to the plane, or so nearly that t overflows. */
    test.t = -test.n_dot_o_plus_d / test.n_dot_r;
    if (test.n_dot_r == 0 || !isfinite(test.t)) {
        test.t = 0;
        test.verdict = FACE_PARALLEL;
        return test;
    }
    /* A quotient that underflows to 0 is still on the side that its signs say. */
    bool ahead = test.n_dot_o_plus_d != 0 && (test.n_dot_o_plus_d < 0) == (test.n_dot_r > 0);
    bool inside = (complete || ahead) && inside_edges(&test, face, ray.origin, r, complete);
    if (inside)
        test.t = accurate_t(face, plane, ray);
    if (!ahead)
        test.verdict = FACE_BEHIND;
    else if (face->one_sided && test.n_dot_r > 0)
        test.verdict = FACE_BACK;
    else if (inside)
        test.verdict = hit_verdict(&test, interval_in_box(face_box(face, plane), ray.origin, ray.direction), limit);
    else
        test.verdict = test.t > limit ? FACE_FARTHER : FACE_OUTSIDE;
    return test;
}

FaceTest face_test_segment(const Face *face, const Plane *plane, Vec3 from, Vec3 to, bool complete)
{
    FaceTest test = {.outside_edge = -1};
    ExactVec3 r = exact_difference(to, from);
    double start = plane_distance(face, plane, from), end = plane_distance(face, plane, to);
    test.n_dot_r = normal_dot(face, plane, r);
    test.n_dot_o_plus_d = start;
    if (test.n_dot_r == 0) {
        test.verdict = FACE_PARALLEL;
        return test;
    }
    /* Between means: the ends lie on different sides of the plane, neither of them in it. */
    bool between = (start < 0 && end > 0) || (start > 0 && end < 0);
    test.t = between ? start / (start - end) : -start / test.n_dot_r;
    bool inside = (complete || between) && inside_edges(&test, face, from, r, complete);
    if (between && face->one_sided && start < 0)
        test.verdict = FACE_BACK;
    else if (between && inside)
        test.verdict = hit_verdict(&test, interval_in_box(face_box(face, plane), from, r.high), 1);
    else if (between)
        test.verdict = FACE_OUTSIDE;
    else
        test.verdict = start == 0 || (start < 0) == (test.n_dot_r < 0) ? FACE_BEHIND : FACE_FARTHER;
    return test;
}

Vec3 point_shifted(const Face *face, const Plane *plane, Vec3 n, Vec3 point)
{
    ExactVec3 x = from_vertex(face, point);
    double height = normal_dot_accurate(face, plane, x).high;
    if (vec3_dot(n, plane->normal) < 0)
        height = -height;
    /* What rounding may take away: half an ulp of each coordinate
     * of the sum, a few of the step, what the height lacks. */
    double margin =
        2 * ROUNDING * vec3_magnitudes(point) + 12 * ROUNDING * fabs(height) + accurate_bound(plane, x.high);
    margin = margin > 0x1p-100 ? margin : 0x1p-100;
    return vec3_add(point, vec3_scale(margin - height, n));
}
