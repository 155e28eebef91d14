/* Slips of steps 3 and 5: the plane and the nearest face. Shadow rays come by the same test, up to t = 1. */
#include "grade/slip.h"
#include "grade/slip_test.h"

#include <stddef.h>

/* --- 3: the plane --- */

static FaceTest t_negated(const Scene *scene, int face, Ray ray)
{
    FaceTest test = slip_test_plane(scene, face, ray);
    test.t = -test.t;
    return slip_test_with_t(scene, face, ray, test);
}

static FaceTest n_dot_r_negated(const Scene *scene, int face, Ray ray)
{
    FaceTest test = slip_test_plane(scene, face, ray);
    test.n_dot_r = -test.n_dot_r;
    test.t = -test.t;
    return slip_test_with_t(scene, face, ray, test);
}

/* In the file's coordinates, where N.O and D are what a student's program has. */
static double world_dot(const Scene *scene, Vec3 n, Vec3 position)
{
    return vec3_dot(n, vec3_add(position, scene->centre));
}

static FaceTest d_negated(const Scene *scene, int face, Ray ray)
{
    FaceTest test = slip_test_plane(scene, face, ray);
    Vec3 n = scene->planes[face].normal;
    test.n_dot_o_plus_d = world_dot(scene, n, ray.origin) + world_dot(scene, n, face_vertex(&scene->faces[face], 0));
    test.t = -test.n_dot_o_plus_d / test.n_dot_r;
    return slip_test_with_t(scene, face, ray, test);
}

static FaceTest without_d(const Scene *scene, int face, Ray ray)
{
    FaceTest test = slip_test_plane(scene, face, ray);
    test.n_dot_o_plus_d = world_dot(scene, scene->planes[face].normal, ray.origin);
    test.t = -test.n_dot_o_plus_d / test.n_dot_r;
    return slip_test_with_t(scene, face, ray, test);
}

static FaceTest behind_counts(const Scene *scene, int face, Ray ray)
{
    FaceTest test = slip_test_taught(scene, face, ray);
    return slip_test_judged(test, test.n_dot_r != 0 && slip_test_faces_ray(scene, face, &test) &&
                                      slip_test_inside(&test, 0, test.edges));
}

static FaceTest t_without_sign(const Scene *scene, int face, Ray ray)
{
    FaceTest test = slip_test_plane(scene, face, ray);
    test.t = fabs(test.t);
    return slip_test_with_t(scene, face, ray, test);
}

static FaceTest back_counts(const Scene *scene, int face, Ray ray)
{
    FaceTest test = slip_test_taught(scene, face, ray);
    return slip_test_judged(test, test.n_dot_r != 0 && test.t > 0 && slip_test_inside(&test, 0, test.edges));
}

static FaceTest front_left_out(const Scene *scene, int face, Ray ray)
{
    FaceTest test = slip_test_taught(scene, face, ray);
    bool seen = !scene->faces[face].one_sided || test.n_dot_r > 0;
    return slip_test_judged(test, test.n_dot_r != 0 && test.t > 0 && seen && slip_test_inside(&test, 0, test.edges));
}

static FaceTest one_sided_left_out(const Scene *scene, int face, Ray ray)
{
    FaceTest test = slip_test_taught(scene, face, ray);
    return slip_test_judged(test, test.verdict == FACE_INSIDE && !scene->faces[face].one_sided);
}

static FaceTest all_backs_left_out(const Scene *scene, int face, Ray ray)
{
    FaceTest test = slip_test_taught(scene, face, ray);
    return slip_test_judged(test, test.n_dot_r < 0 && test.t > 0 && slip_test_inside(&test, 0, test.edges));
}

static FaceTest t_negated_at_last(const Scene *scene, int face, Ray ray)
{
    FaceTest test = face_test(&scene->faces[face], &scene->planes[face], ray, HUGE_VAL, false);
    test.t = -test.t;
    return test;
}

/* --- 5: the nearest --- */

static bool farthest(const SlipHit *nearest, double t)
{
    return nearest->face < 0 || t > nearest->test.t_in_box;
}

static bool last(const SlipHit *nearest, double t)
{
    (void)nearest;
    (void)t;
    return true;
}

static bool first(const SlipHit *nearest, double t)
{
    (void)t;
    return nearest->face < 0;
}

static bool last_of_equal(const SlipHit *nearest, double t)
{
    return nearest->face < 0 || t <= nearest->test.t_in_box;
}

#define PLANE "algorithm.md#3-the-plane-hit"
#define NEAREST "algorithm.md#5-nearest-and-ties"

const Slip slip_face[] = {
    {"t-sign", "The sign of t is wrong: faces behind the eye are seen, those before it are not.",
     "t = -(N.O + D) / (N.R)", "t = (N.O + D) / (N.R)", PLANE, .steps = {.test = t_negated}},
    {"n-dot-r-sign", "The sign of N.R is wrong.", "N.R", "-(N.R)", PLANE, .steps = {.test = n_dot_r_negated}},
    {"d-sign", "The sign of D is wrong.", "D = -(N.v0)", "D = N.v0", "algorithm.md#2-faces-and-their-planes",
     .steps = {.test = d_negated}},
    {"d-forgotten", "D is forgotten: every plane goes through the origin.", "t = -(N.O + D) / (N.R)",
     "t = -(N.O) / (N.R)", "algorithm.md#2-faces-and-their-planes", .steps = {.test = without_d}},
    {"t-sign-at-last", "The right face is found, but its t has the wrong sign, and P is behind the eye.",
     "t = -(N.O + D) / (N.R)", "t = (N.O + D) / (N.R), after the test", PLANE,
     .steps = {.test = t_negated_at_last, .shadows_apart = true}},
    {"behind-counts", "Faces behind the eye are hit, too: t may be negative, and the smallest t counts.",
     "a hit has t > 0", "any t", PLANE, .steps = {.test = behind_counts}},
    {"t-without-sign", "The sign of t is dropped: faces behind the eye are seen as if they were before it.",
     "a hit has t > 0", "|t|", PLANE, .steps = {.test = t_without_sign}},
    {"one-sided-ignored", "One-sided faces are seen from behind, too.", "one-sided: N.R < 0", "any N.R", PLANE,
     .steps = {.test = back_counts}},
    {"one-sided-reversed", "One-sided faces are seen from behind instead of from the front.", "one-sided: N.R < 0",
     "one-sided: N.R > 0", PLANE, .steps = {.test = front_left_out}},
    {"one-sided-left-out", "One-sided faces are not seen at all.", "one-sided: N.R < 0", "one-sided: never", PLANE,
     .steps = {.test = one_sided_left_out}},
    {"all-one-sided", "All faces are seen from the front only, also those that have two sides.",
     "N.R < 0 is asked of one-sided faces only", "N.R < 0 is asked of all faces", PLANE,
     .steps = {.test = all_backs_left_out}},
    {"farthest", "The farthest face is taken, not the nearest.", "the smallest t", "the largest t", NEAREST,
     .steps = {.nearer = farthest}},
    {"last-face", "The last face of the file that is hit is taken, not the nearest.", "the smallest t",
     "the last one found", NEAREST, .steps = {.nearer = last}},
    {"first-face", "The first face of the file that is hit is taken, not the nearest.", "the smallest t",
     "the first one found", NEAREST, .steps = {.nearer = first}},
    {"last-of-equal", "Of faces that are equally near the last one is taken.", "of equal t, the first in the file",
     "of equal t, the last in the file", NEAREST, .steps = {.nearer = last_of_equal}},
    {0},
};
