/* Tests of shifted_point. Included by test.c alone, after the student's file. */
#ifndef EXERCISE_POINTS_H
#define EXERCISE_POINTS_H

#include "exercises/08/judge.h"

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
            slip_of_point(name, got,
                          "the shift is a fixed length: too short for a large scene, too long for a small "
                          "one. It has to grow with the numbers that were rounded");
    if (moved_by(got, p, n, -height) || moved_by(got, p, n, 0))
        slip_of_point(name, got,
                      "a margin is missing: the point is brought to the plane at most, not above it, and the "
                      "sum is rounded, too");
    for (int k = 1; k <= 64; k++) {
        if (moved_by(got, p, n, k * ROUNDING * size))
            slip_of_point(name, got,
                          "the height of P is not asked: it may lie deeper than the shift is long. Shift by "
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
        judge_point(&scene->faces[face], &scene->planes[face], false, hit_of(scene, face, column + i, row + i % 8));
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
        judge_point(&scene->faces[0], &scene->planes[0], i % 2 == 1, vec3_add(p, vec3_scale(i % 3 ? 1e-9 : -1e-9, n)));
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

#endif
