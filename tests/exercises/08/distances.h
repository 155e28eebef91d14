/* Tests of distance_from_plane. Included by test.c alone, after the student's file. */
#ifndef EXERCISE_DISTANCES_H
#define EXERCISE_DISTANCES_H

#include "exercises/08/judge.h"

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

#endif
