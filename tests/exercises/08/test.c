/* Exercise 8, rounding: what the student's functions answer, judged by exact arithmetic. Inputs are of the lessons of
 * docs/rounding.md, and at random near what is hard. */
#include "exercises/exercise.h"

#include "exercises/08/rounding.h"
#include "scene/exact.h"
#include "scene/light.h"
#include "support/xorshift.h"
#include "trace/reference.h"

#include <stdio.h>

static int exact_calls;

int exact_side_of_edge(Vec3 o, Vec3 r, Vec3 a, Vec3 b)
{
    exact_calls++;
    double value = exact_determinant(exact_vec3(r), exact_difference(a, o), exact_difference(b, o));
    return (value > 0) - (value < 0);
}

#include "exercises/student.h"

#define ACNE "scenes/lessons/acne.json"
#define LEAK "scenes/lessons/leak.json"
#define CRACKS "scenes/lessons/cracks.json"
#define FAR "scenes/lessons/far.json"
#define CAMERA "scenes/lessons/camera_in_the_plane.json"

enum { RANDOM_TRIES = 2000 };

/* N.(point - v0) to within an ulp, its sign exact: the plane is that of the face's diagonals. */
static double true_distance(const Face *face, const Plane *plane, Vec3 point)
{
    ExactVec3 a = exact_difference(face_vertex(face, 2), face_vertex(face, 0));
    ExactVec3 b = exact_difference(face_vertex(face, 3 % face->vertex_count), face_vertex(face, 1));
    return exact_determinant(exact_difference(point, face_vertex(face, 0)), a, b) / plane->length;
}

static const char *long_text(double value)
{
    static char texts[8][40];
    static int next;
    char *text = texts[next++ % 8];
    snprintf(text, sizeof texts[0], "%.17g", value);
    return text;
}

static const char *point_text(Vec3 v)
{
    static char texts[8][120];
    static int next;
    char *text = texts[next++ % 8];
    snprintf(text, sizeof texts[0], "(%.17g, %.17g, %.17g)", v.x, v.y, v.z);
    return text;
}

static void give_plane(const Face *face, const Plane *plane)
{
    given("N", "%s", point_text(plane->normal));
    given("v0", "%s", point_text(face_vertex(face, 0)));
}

/* A face through the origin or another point, across the axes or not. */
static Face face_at(Vec3 corner, Vec3 along, Vec3 up)
{
    Face face = {.vertex_count = 4};
    Vec3 corners[4] = {corner, vec3_add(corner, along), vec3_add(vec3_add(corner, along), up), vec3_add(corner, up)};
    for (int k = 0; k < 4; k++)
        for (int axis = 0; axis < 3; axis++)
            face.vertices[k][axis] = (float)vec3_component(corners[k], axis);
    return face;
}

static double between(uint64_t *random, double low, double high)
{
    return low + (high - low) * ((double)(random_next(random) >> 11) * 0x1p-53);
}

static Vec3 random_vector(uint64_t *random, double size)
{
    double x = between(random, -size, size), y = between(random, -size, size);
    return vec3(x, y, between(random, -size, size));
}

/* --- 1. The distance from the plane --- */

/* An outcome of one truth, beside the numbers that came back: by them a slip is recognised. */
static Outcome judged(const char *name, bool good, double a, double b)
{
    Outcome outcome = {0};
    add_truth(&outcome, name, good);
    add_number(&outcome, "value", a);
    add_number(&outcome, "error", b);
    return outcome;
}

#define HOLDS "the true distance is within value - error and value + error"
#define SMALL "error is at most 32 u |O - v0|"

/* Bit for bit: what is left of a cancellation is below the tolerance of `compare`. */
static void slip_of_distance(const char *name, Distance got, double value, double error, const char *words)
{
    Outcome outcome = judged(name, false, got.value, got.error);
    if (got.value == value && got.error == error)
        slip(&outcome, "%s", words);
}

static void slips_of_distance(const char *name, const Face *face, const Plane *plane, Vec3 o, Distance got)
{
    Vec3 n = plane->normal, v0 = face_vertex(face, 0), x = vec3_sub(o, v0);
    double value = vec3_dot(n, x), size = vec3_magnitudes(x), own = got.error;
    slip_of_distance(name, got, -value, own, "the sign is the wrong way round: O - v0, not v0 - O");
    slip_of_distance(name, got, value, 0, "the error is 0: even a good number is rounded");
    slip_of_distance(name, got, value, ROUNDING * fabs(value),
                     "the error is u |value|: what is left after a cancellation is smaller than the roundings in it. "
                     "The error comes from the products, so it grows with |O - v0|");
    slip_of_distance(name, got, value, ROUNDING * size,
                     "the error is u |O - v0|, one rounding: count them all, also that of N");
    for (int k = 1; k <= 16; k++)
        slip_of_distance(name, got, value, k * ROUNDING * vec3_magnitudes(o),
                         "the error grows with |O|, not with |O - v0|: a face far from the origin is not less flat");
    if (got.value == vec3_dot(n, o) - vec3_dot(n, v0) || got.value == vec3_dot(n, o) + plane->d)
        slip_of_distance(name, got, got.value, own,
                         "N.O + D is computed: two large numbers nearly cancel, and what is left is their rounding. "
                         "Subtract O - v0 first");
}

/* What is true of a distance: 1, it holds the true one; 2, it is not too large; else which of them fails. */
static void judge_distance(const Face *face, const Plane *plane, Vec3 o)
{
    Distance got = distance_from_plane(face, plane, o);
    double truth = true_distance(face, plane, o), size = vec3_magnitudes(vec3_sub(o, face_vertex(face, 0)));
    bool holds = fabs(got.value - truth) <= got.error, small = got.error <= 32 * ROUNDING * size;
    if (holds && small)
        return;
    given("O", "%s", point_text(o));
    give_plane(face, plane);
    given("value", "%s", long_text(got.value));
    given("error", "%s", long_text(got.error));
    given("truth", "%s", long_text(truth));
    const char *name = holds ? SMALL : HOLDS;
    slips_of_distance(name, face, plane, o, got);
    Outcome returned = judged(name, false, got.value, got.error), expected = judged(name, true, got.value, got.error);
    Outcome told = {0};
    add_truth(&told, name, true);
    if (holds)
        add_formula(&told, "error = %s, but 32 u |O - v0| = 32 u %s = %s", number_text(got.error), number_text(size),
                    number_text(32 * ROUNDING * size));
    else
        add_formula(&told, "|value - truth| = |%s - %s| = %s, but error = %s", number_text(got.value),
                    number_text(truth), number_text(fabs(got.value - truth)), number_text(got.error));
    expected.values[0] = told.values[0];
    compare(&returned, &expected);
}

/* By hand: the ground, and a point over it. */
static void height_over_the_ground(void)
{
    Face ground = face_at(vec3(0, 1, 0), vec3(0, 0, 4), vec3(4, 0, 0));
    Plane plane = face_plane(&ground);
    for (int k = 0; k < 2; k++) {
        Vec3 o = vec3(1, k == 0 ? 3 : -2, 2);
        shown_at(CAMERA, 228, 171);
        given("O", "%s", vector_text(o));
        give_plane(&ground, &plane);
        Distance got = distance_from_plane(&ground, &plane, o);
        Outcome returned = {0}, expected = {0}, slipped = {0}, by_d = {0};
        add_number(&returned, "value", got.value);
        add_number(&expected, "value", k == 0 ? 2 : -3);
        add_formula(&expected, "N.(O - v0) = (0, 1, 0).(%s - (0, 1, 0)) = %s", vector_text(o),
                    number_text(k == 0 ? 2 : -3));
        add_number(&slipped, "value", k == 0 ? -2 : 3);
        slip(&slipped, "the sign is the wrong way round: O - v0, not v0 - O");
        add_number(&by_d, "value", o.y);
        slip(&by_d, "v0 is left out: N.O is the distance from the origin's plane");
        compare(&returned, &expected);
        judge_distance(&ground, &plane, o);
    }
}

/* The floor of lesson 4, and points on it: coordinates of kilometres, distances of nothing. */
static void far_from_the_origin(void)
{
    const Scene *scene = scene_of(FAR);
    shown_at(FAR, 110, 191);
    uint64_t random = 7;
    for (int i = 0; i < RANDOM_TRIES; i++) {
        const Face *face = &scene->faces[i % 2 ? 0 : i % scene->face_count];
        Vec3 a = face_vertex(face, 0), b = face_vertex(face, 1), c = face_vertex(face, 2);
        Vec3 o = vec3_add(a, vec3_add(vec3_scale(between(&random, 0, 1), vec3_sub(b, a)),
                                      vec3_scale(between(&random, 0, 1), vec3_sub(c, b))));
        judge_distance(face, &scene->planes[face - scene->faces], o);
    }
}

/* Slanted planes through anywhere, points near them and far from them. */
static void errors_are_bounds(void)
{
    uint64_t random = 11;
    shown_at(ACNE, 9, 225);
    for (int i = 0; i < RANDOM_TRIES; i++) {
        double size = ldexp(1, (int)between(&random, -20, 20));
        Face face = face_at(random_vector(&random, size), random_vector(&random, size), random_vector(&random, size));
        Plane plane = face_plane(&face);
        if (!(plane.length > 0.01 * size * size) || plane.error > 1e-29)
            continue;
        Vec3 a = face_vertex(&face, 0), b = face_vertex(&face, 1), c = face_vertex(&face, 2);
        Vec3 o = vec3_add(a, vec3_add(vec3_scale(between(&random, -1, 2), vec3_sub(b, a)),
                                      vec3_scale(between(&random, -1, 2), vec3_sub(c, b))));
        judge_distance(&face, &plane, i % 4 ? o : vec3_add(o, random_vector(&random, size)));
    }
}

/* --- 2. The shifted point --- */

#define ABOVE "the shifted point lies above the plane"
#define NEAR "it lies at most 64 u (|P| + |P - v0|) + 1e-25 above it"

static Outcome judged_point(const char *name, bool good, Vec3 point)
{
    Outcome outcome = {0};
    add_truth(&outcome, name, good);
    add_vector(&outcome, "the point", point);
    return outcome;
}

static void slip_of_point(const char *name, Vec3 point, const char *words)
{
    Outcome outcome = judged_point(name, false, point);
    slip(&outcome, "%s", words);
}

/* Whether the point is as far along n as if it had been moved so far: shifts as small as these are lost in 1e-9. */
static bool moved_by(Vec3 got, Vec3 p, Vec3 n, double length)
{
    Vec3 moved = vec3_add(p, vec3_scale(length, n));
    return got.x == moved.x && got.y == moved.y && got.z == moved.z;
}

static void slips_of_point(const char *name, Vec3 v0, Vec3 n, Vec3 p, Vec3 got)
{
    double height = vec3_dot(n, vec3_sub(p, v0)), size = vec3_magnitudes(p);
    static const double lengths[] = {1e-3, 1e-4, 1e-5, 1e-6, 1e-7, 1e-8, 1e-9, 1e-10, 1e-12};
    for (int k = 0; k < 9; k++)
        if (moved_by(got, p, n, lengths[k]))
            slip_of_point(name, got, "the shift is a fixed length: too short for a large scene, too long for a small "
                                     "one. It has to grow with the numbers that were rounded");
    if (moved_by(got, p, n, -height) || moved_by(got, p, n, 0))
        slip_of_point(name, got, "a margin is missing: the point is brought to the plane at most, not above it, and the "
                                 "sum is rounded, too");
    for (int k = 1; k <= 64; k++) {
        if (moved_by(got, p, n, k * ROUNDING * size))
            slip_of_point(name, got, "the height of P is not asked: it may lie deeper than the shift is long. Shift by "
                                     "a margin minus the height");
        if (moved_by(got, p, n, k * ROUNDING * size + height))
            slip_of_point(name, got, "the height is added, not taken away: a point below the plane goes deeper");
        if (moved_by(got, p, n, -k * ROUNDING * size - height))
            slip_of_point(name, got, "the margin goes against n");
    }
}

static void judge_point(const Face *face, const Plane *plane, bool from_behind, Vec3 p)
{
    Vec3 n = from_behind ? vec3_negate(plane->normal) : plane->normal, v0 = face_vertex(face, 0);
    Vec3 got = shifted_point(face, plane, n, p);
    double before = true_distance(face, plane, p), height = true_distance(face, plane, got);
    before = from_behind ? -before : before;
    height = from_behind ? -height : height;
    double most = 64 * ROUNDING * (vec3_magnitudes(p) + vec3_magnitudes(vec3_sub(p, v0))) + 1e-25;
    bool above = height > 0, near = height <= most && vec3_length(vec3_sub(got, p)) <= 2 * (fabs(before) + most);
    if (above && near)
        return;
    given("P", "%s", point_text(p));
    given("n", "%s%s", point_text(n), from_behind ? ", the opposite of N" : "");
    given("v0", "%s", point_text(v0));
    given("P lies", "%s high", number_text(before));
    given("your point", "%s", point_text(got));
    const char *name = above ? NEAR : ABOVE;
    slips_of_point(name, v0, n, p, got);
    Outcome returned = judged_point(name, false, got), expected = judged_point(name, true, got);
    Outcome told = {0};
    add_truth(&told, name, true);
    add_formula(&told, "its height is %s, and it may be more than 0 and at most %s", number_text(height),
                number_text(most));
    expected.values[0] = told.values[0];
    compare(&returned, &expected);
}

/* The first hit of a pixel's ray with that face, as textbook arithmetic computes it. */
static Vec3 hit_of(const Scene *scene, int face, int column, int row)
{
    View view = view_of(scene);
    Vec3 r = view_direction(&view, column, row, 0, 0);
    const Plane *plane = &scene->planes[face];
    double t = -(vec3_dot(plane->normal, view.eye) + plane->d) / vec3_dot(plane->normal, r);
    return vec3_add(view.eye, vec3_scale(t, r));
}

/* All points of a face that its pixels see, from a pixel on. */
static void judge_pixels(const char *path, int face, int column, int row)
{
    const Scene *scene = scene_of(path);
    shown_at(path, column, row);
    for (int i = 0; i < 60; i++)
        judge_point(&scene->faces[face], &scene->planes[face], false,
                    hit_of(scene, face, column + i, row + i % 8));
}

static void no_leak(void)
{
    judge_pixels(LEAK, 0, 84, 161);
}

static void no_acne(void)
{
    judge_pixels(ACNE, 0, 9, 225);
}

/* Points that lie deeper than their own rounding, and faces that are left from behind. */
static void from_where_it_is(void)
{
    const Scene *scene = scene_of(ACNE);
    shown_at(ACNE, 9, 225);
    for (int i = 0; i < 60; i++) {
        Vec3 p = hit_of(scene, 0, 9 + i, 225), n = scene->planes[0].normal;
        judge_point(&scene->faces[0], &scene->planes[0], i % 2 == 1,
                    vec3_add(p, vec3_scale(i % 3 ? 1e-9 : -1e-9, n)));
    }
}

/* The margin must not become 0 where the coordinates do. */
static void at_the_origin(void)
{
    Face face = face_at(vec3(0, 0, 0), vec3(1, 0, 0), vec3(0, 1, 0));
    Plane plane = face_plane(&face);
    shown_at(CAMERA, 60, 120);
    Vec3 zero = vec3(0, 0, 0);
    Vec3 got = shifted_point(&face, &plane, plane.normal, zero);
    if (got.z == 0) {
        Outcome slipped = judged_point(ABOVE, false, got);
        slip(&slipped, "the margin is 0, because all numbers here are: it needs a least length, such as 2^-100");
        given("P", "(0, 0, 0)");
        give_plane(&face, &plane);
        Outcome expected = judged_point(ABOVE, true, got), returned = judged_point(ABOVE, false, got);
        compare(&returned, &expected);
    }
    judge_point(&face, &plane, false, zero);
    judge_point(&face, &plane, true, vec3(1e-30, 0, 0));
}

/* --- 3. The side of an edge --- */

static double rounded_side(Vec3 o, Vec3 r, Vec3 a, Vec3 b)
{
    return vec3_dot(r, vec3_cross(vec3_sub(a, o), vec3_sub(b, o)));
}

static int sign_of(double x)
{
    return (x > 0) - (x < 0);
}

/* As `rounded_side`, each product by its magnitude. */
static double magnitude_of(Vec3 o, Vec3 r, Vec3 a, Vec3 b)
{
    Vec3 p = vec3_sub(a, o), q = vec3_sub(b, o);
    return fabs(r.x) * (fabs(p.y * q.z) + fabs(p.z * q.y)) + fabs(r.y) * (fabs(p.z * q.x) + fabs(p.x * q.z)) +
           fabs(r.z) * (fabs(p.x * q.y) + fabs(p.y * q.x));
}

static int true_side(Vec3 o, Vec3 r, Vec3 a, Vec3 b)
{
    int calls = exact_calls, side = exact_side_of_edge(o, r, a, b);
    exact_calls = calls;
    return side;
}

static void judge_side(Vec3 o, Vec3 r, Vec3 a, Vec3 b)
{
    int calls = exact_calls, side = side_of_edge(o, r, a, b), truth = true_side(o, r, a, b);
    double value = rounded_side(o, r, a, b), magnitude = magnitude_of(o, r, a, b);
    bool asked = exact_calls > calls, may_ask = fabs(value) <= 40 * ROUNDING * magnitude;
    if (side == truth && (!asked || may_ask))
        return;
    given("O", "%s", point_text(o));
    given("R", "%s", point_text(r));
    given("A", "%s", point_text(a));
    given("B", "%s", point_text(b));
    given("rounded", "R.((A - O) x (B - O)) = %s", long_text(value));
    given("in doubt", "below some 10 u %s = %s", number_text(magnitude), number_text(10 * ROUNDING * magnitude));
    Outcome returned = {0}, expected = {0}, slipped = {0}, turned = {0};
    if (side == truth) {
        add_integer(&returned, "calls of exact_side_of_edge", exact_calls - calls);
        add_integer(&expected, "calls of exact_side_of_edge", 0);
        slip(&returned, "the exact function is asked where the rounded number is sure: a tracer that does this is "
                        "slow");
        compare(&returned, &expected);
    }
    add_integer(&returned, "the side", side);
    add_integer(&expected, "the side", truth);
    add_formula(&expected, "the true sign of R.((A - O) x (B - O)) is %s", truth > 0 ? "+" : truth < 0 ? "-" : "0");
    if (!asked && fabs(value) <= 10 * ROUNDING * magnitude && side == sign_of(value)) {
        add_integer(&slipped, "the side", side);
        slip(&slipped, "the sign of the rounded number is taken where rounding may have turned it: compare it with a "
                       "bound, and ask exact_side_of_edge below it");
    }
    if (!asked && side == 0 && truth != 0) {
        add_integer(&turned, "the side", 0);
        slip(&turned, "a number in doubt is taken for 0: 0 is an answer, too, and it has to be true");
    } else if (side == -truth && truth != 0) {
        add_integer(&turned, "the side", -truth);
        slip(&turned, "the sign is the wrong way round: (A - O) x (B - O), in this order");
    }
    compare(&returned, &expected);
}

static void clear_sides(void)
{
    shown_at(CRACKS, 190, 124);
    judge_side(vec3(0, 0, 0), vec3(0, 0, -1), vec3(1, -1, -4), vec3(1, 1, -4));
    judge_side(vec3(0, 0, 0), vec3(0, 0, -1), vec3(-1, -1, -4), vec3(-1, 1, -4));
    uint64_t random = 5;
    for (int i = 0; i < RANDOM_TRIES; i++)
        judge_side(random_vector(&random, 10), random_vector(&random, 1), random_vector(&random, 10),
                   random_vector(&random, 10));
}

/* The edges of the tiles, from both tiles: rays through pixels that lie on them. */
static void shared_edges(void)
{
    const Scene *scene = scene_of(CRACKS);
    View view = view_of(scene);
    shown_at(CRACKS, 190, 124);
    for (int column = 10; column < view.columns; column += 20)
        for (int row = 4; row < view.rows; row += 20) {
            Vec3 r = view_direction(&view, column, row, 0, 0);
            for (int i = 0; i < scene->face_count; i += 3)
                for (int k = 0; k < scene->faces[i].vertex_count; k++) {
                    Vec3 a = face_vertex(&scene->faces[i], k);
                    Vec3 b = face_vertex(&scene->faces[i], (k + 1) % scene->faces[i].vertex_count);
                    judge_side(view.eye, r, a, b);
                    judge_side(view.eye, r, b, a);
                }
        }
}

/* Rays aimed at points of an edge: nothing but exact arithmetic knows the side. */
static void rays_at_an_edge(void)
{
    uint64_t random = 3;
    shown_at(CRACKS, 190, 124);
    for (int i = 0; i < RANDOM_TRIES; i++) {
        Vec3 o = random_vector(&random, 10), a = random_vector(&random, 10), b = random_vector(&random, 10);
        Vec3 p = vec3_add(a, vec3_scale(between(&random, -0.2, 1.2), vec3_sub(b, a)));
        judge_side(o, vec3_sub(p, o), a, b);
        judge_side(o, vec3_sub(p, o), b, a);
    }
    judge_side(vec3(0, 0, 0), vec3(1, 1, -2), vec3(1, 1, -2), vec3(3, 1, -2));
}

/* --- The lessons' pictures --- */

/* The side of the plane that a point lies on: the student's distance, and the exact side where it is in doubt. */
static int side_of(const Face *face, const Plane *plane, Vec3 point)
{
    Distance distance = distance_from_plane(face, plane, point);
    return fabs(distance.value) > distance.error ? sign_of(distance.value) : plane_side(face, plane, point);
}

static bool passes_inside(const Face *face, Vec3 o, Vec3 r, int towards)
{
    for (int k = 0; k < face->vertex_count; k++) {
        Vec3 a = face_vertex(face, k), b = face_vertex(face, (k + 1) % face->vertex_count);
        if (side_of_edge(o, r, a, b) * towards < 0)
            return false;
    }
    return true;
}

static int nearest_of(const Scene *scene, Ray ray, double *t)
{
    int nearest = -1;
    *t = HUGE_VAL;
    for (int i = 0; i < scene->face_count; i++) {
        const Face *face = &scene->faces[i];
        const Plane *plane = &scene->planes[i];
        double approach = vec3_dot(plane->normal, ray.direction);
        int towards = sign_of(approach), side = side_of(face, plane, ray.origin);
        if (towards * side >= 0)
            continue;
        double own = -distance_from_plane(face, plane, ray.origin).value / approach;
        if (own < *t && passes_inside(face, ray.origin, ray.direction, towards)) {
            nearest = i;
            *t = own;
        }
    }
    return nearest;
}

static bool is_blocked(const Scene *scene, Vec3 from, Vec3 light)
{
    Vec3 r = vec3_sub(light, from);
    for (int i = 0; i < scene->face_count; i++) {
        const Face *face = &scene->faces[i];
        const Plane *plane = &scene->planes[i];
        int start = side_of(face, plane, from);
        if (start * side_of(face, plane, light) < 0 && passes_inside(face, from, r, -start))
            return true;
    }
    return false;
}

/* A pixel of a scene without mirrors, by the student's three functions. */
static Vec3 student_pixel(const Textbook *textbook, int column, int row, unsigned char rgb[3])
{
    const Scene *scene = textbook->scene;
    View view = view_of(scene);
    view.grid = 1;
    Ray ray = {view.eye, view_direction(&view, column, row, 0, 0)};
    double t;
    int index = nearest_of(scene, ray, &t);
    Vec3 colour = index < 0 ? scene->shading.background : vec3(0, 0, 0);
    if (index >= 0) {
        const Face *face = &scene->faces[index];
        const Plane *plane = &scene->planes[index];
        Vec3 p = vec3_add(ray.origin, vec3_scale(t, ray.direction));
        bool behind = vec3_dot(plane->normal, ray.direction) > 0;
        Vec3 n = behind ? vec3_negate(plane->normal) : plane->normal, v = vec3_unit(vec3_sub(view.eye, p));
        Vec3 shifted = shifted_point(face, plane, n, p);
        for (int i = 0; i < scene->light_count; i++) {
            Vec3 light = scene->lights[i].position;
            int side = side_of(face, plane, light);
            bool reaches = (behind ? -side : side) > 0 && !is_blocked(scene, shifted, light);
            Illumination terms = illuminate(&scene->materials[face->material], &scene->lights[i], n,
                                            vec3_unit(vec3_sub(light, p)), v);
            colour = vec3_add(colour, terms.ambient);
            if (reaches)
                colour = vec3_add(colour, vec3_add(terms.diffuse, terms.specular));
        }
    }
    rgb[0] = colour_to_byte(colour.x);
    rgb[1] = colour_to_byte(colour.y);
    rgb[2] = colour_to_byte(colour.z);
    return colour;
}

static Vec3 our_pixel(const Textbook *textbook, int column, int row, unsigned char rgb[3])
{
    RenderReport report = {0};
    Scene scene = *textbook->scene;
    scene.grid = 1;
    Tracer tracer = {.scene = &scene, .report = &report};
    Vec3 colour = reference_pixel(&tracer, column, row);
    rgb[0] = colour_to_byte(colour.x);
    rgb[1] = colour_to_byte(colour.y);
    rgb[2] = colour_to_byte(colour.z);
    return colour;
}

/* Rows of a lesson, pixel by pixel, with the student's functions and with ours. */
static void judge_rows(const char *path, int first, int last, int step)
{
    const Scene *scene = scene_of(path);
    RenderReport report = {0};
    Textbook textbook = {.scene = scene, .report = &report};
    for (int row = first; row < last; row += step)
        for (int column = 0; column < scene->screen.columns; column += step) {
            unsigned char theirs[3], ours[3];
            student_pixel(&textbook, column, row, theirs);
            our_pixel(&textbook, column, row, ours);
            Outcome returned = {0}, expected = {0};
            for (int k = 0; k < 3; k++) {
                add_integer(&returned, (const char *[]){"red", "green", "blue"}[k], theirs[k]);
                add_integer(&expected, (const char *[]){"red", "green", "blue"}[k], ours[k]);
            }
            shown_at(path, column, row);
            compare(&returned, &expected);
        }
}

static void acne_is_gone(void)
{
    judge_rows(ACNE, 120, 240, 5);
}

static void cracks_are_gone(void)
{
    judge_rows(CRACKS, 120, 129, 4);
    judge_rows(CRACKS, 30, 31, 2);
}

static const ExerciseTest TESTS[] = {
    {"height_over_the_ground", "The height of a point over the ground", height_over_the_ground},
    {"far_from_the_origin", "Distances far from the origin, as in lesson 4", far_from_the_origin},
    {"errors_are_bounds", "The error of a distance, at 2000 planes", errors_are_bounds},
    {"no_leak", "Shifted points in a small scene, as in lesson 2", no_leak},
    {"no_acne", "Shifted points in a large scene, as in lesson 1", no_acne},
    {"from_where_it_is", "Points that lie deep, and faces from behind", from_where_it_is},
    {"at_the_origin", "A point whose coordinates are 0", at_the_origin},
    {"clear_sides", "Sides of edges that the ray passes at a distance", clear_sides},
    {"shared_edges", "Both sides of the edges of lesson 3", shared_edges},
    {"rays_at_an_edge", "Rays aimed at an edge", rays_at_an_edge},
    {"acne_is_gone", "Pixels of lesson 1", acne_is_gone},
    {"cracks_are_gone", "Pixels of lesson 3", cracks_are_gone},
    {NULL, NULL, NULL},
};

int main(int argc, char **argv)
{
    Exercise exercise = {.tests = TESTS, .pixel = student_pixel, .ours = our_pixel, .scene = LEAK, .columns = 160,
                         .rows = 120};
    return exercise_main(argc, argv, &exercise);
}
