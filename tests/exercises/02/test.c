/* Exercise 2, planes and t: `meets_plane` of the student beside ours. Each test is the ray of a pixel and a face of the
 * scene. */
#include "exercises/textbook.h"

/* Ours, under another name. */
#define meets_plane our_meets_plane
#undef RECTRAY_TEXTBOOK_PLANE_H
#include "src/trace/textbook_plane.h"
#undef meets_plane

#define SCENE "docs/exercises/02-plane/scene.json"

enum { POSTER, WALL, FLOOR, BEHIND_US, EDGE_ON, RAMP };

typedef enum SlipKind {
    SLIP_NONE,
    SLIP_T_SIGN,
    SLIP_D_SIGN,
    SLIP_NO_D,
    SLIP_UPSIDE_DOWN,
    SLIP_R_FOR_O,
    SLIP_BEHIND,
    SLIP_ZERO,
    SLIP_NOT_PARALLEL,
    SLIP_ONE_SIDE,
    SLIP_ONE_SIDE_FIRST,
    SLIP_UNIT,
    SLIP_SCREEN,
    SLIP_COUNT
} SlipKind;

static const char *const SLIPS[SLIP_COUNT] = {
    [SLIP_T_SIGN] = "t has the wrong sign: the minus before (N.O + D) is missing",
    [SLIP_D_SIGN] = "D has the wrong sign: N.v0 + D = 0, so D = -N.v0",
    [SLIP_NO_D] = "D is missing, as if all planes went through the origin",
    [SLIP_UPSIDE_DOWN] = "the fraction is upside down: (N.R) / (N.O + D)",
    [SLIP_R_FOR_O] = "N.R + D is taken for N.O + D",
    [SLIP_BEHIND] = "a plane behind the ray's origin counts, although t is not greater than 0",
    [SLIP_ZERO] = "t = 0 counts: the ray starts in this plane, and has not yet gone anywhere",
    [SLIP_NOT_PARALLEL] = "nothing is asked before the division by N.R = 0",
    [SLIP_ONE_SIDE] = "a face whose normal points away from the ray is refused",
    [SLIP_ONE_SIDE_FIRST] = "a face whose normal points away from the ray is refused",
    [SLIP_UNIT] = "t is measured in lengths, with a unit direction; it counts how many R the ray has gone",
    [SLIP_SCREEN] = "only what is beyond the screen counts, t >= 1",
};

/* As ours, with a slip in it. */
static bool slipped(SlipKind kind, Real3 n, Real3 v0, RealRay ray, Hit *hit)
{
    if (kind == SLIP_UNIT)
        ray.r = unit(ray.r);
    Real d = kind == SLIP_NO_D ? 0 : kind == SLIP_D_SIGN ? dot(n, v0) : -dot(n, v0);
    hit->n_dot_r = dot(n, ray.r);
    hit->n_dot_o_plus_d = dot(n, kind == SLIP_R_FOR_O ? ray.r : ray.o) + d;
    if (hit->n_dot_r == 0 && kind != SLIP_NOT_PARALLEL)
        return false;
    if (kind == SLIP_ONE_SIDE_FIRST && hit->n_dot_r > 0)
        return false;
    hit->t = -hit->n_dot_o_plus_d / hit->n_dot_r;
    if (kind == SLIP_T_SIGN)
        hit->t = -hit->t;
    if (kind == SLIP_UPSIDE_DOWN)
        hit->t = -hit->n_dot_r / hit->n_dot_o_plus_d;
    if (kind == SLIP_BEHIND)
        return true;
    if (kind == SLIP_ONE_SIDE && hit->n_dot_r > 0)
        return false;
    return kind == SLIP_ZERO ? hit->t >= 0 : kind == SLIP_SCREEN ? hit->t >= 1 : hit->t > 0;
}

static Outcome outcome_of(bool met, const Hit *hit)
{
    Outcome outcome = {0};
    add_number(&outcome, "hit->n_dot_r", hit->n_dot_r);
    add_number(&outcome, "hit->n_dot_o_plus_d", hit->n_dot_o_plus_d);
    add_number(&outcome, "hit->t", hit->t);
    add_truth(&outcome, "the answer", met);
    return outcome;
}

/* Ours, with the formulas. */
static Outcome expected_of(Real3 n, Real3 v0, RealRay ray, Hit hit)
{
    bool met = our_meets_plane(n, v0, ray, &hit);
    bool parallel = hit.n_dot_r == 0;
    Outcome outcome = {0};
    add_number(&outcome, "hit->n_dot_r", hit.n_dot_r);
    add_formula(&outcome, "N.R = %s.%s = %s", text_of(n), text_of(ray.r), number_text(hit.n_dot_r));
    add_number(&outcome, "hit->n_dot_o_plus_d", hit.n_dot_o_plus_d);
    add_formula(&outcome, "D = -N.v0 = -%s.%s = %s, N.O + D = %s.%s + %s = %s", text_of(n), text_of(v0),
                number_text(-dot(n, v0)), text_of(n), text_of(ray.o), number_text(-dot(n, v0)),
                number_text(hit.n_dot_o_plus_d));
    add_number(&outcome, "hit->t", hit.t);
    if (parallel)
        add_formula(&outcome, "N.R = 0: the ray is parallel to the plane, and there is no t");
    else
        add_formula(&outcome, "t = -(N.O + D) / (N.R) = -%s / %s = %s", number_text(hit.n_dot_o_plus_d),
                    number_text(hit.n_dot_r), number_text(hit.t));
    add_truth(&outcome, "the answer", met);
    add_formula(&outcome,
                parallel ? "the ray is parallel to the plane"
                : met    ? "t = %s > 0: the plane is ahead"
                         : "t = %s is not greater than 0",
                number_text(hit.t));
    return outcome;
}

static void try_face(int column, int row, int index)
{
    const Scene *scene = scene_of(SCENE);
    Real3 n = normal_of(scene, index), v0 = vertex(&scene->faces[index], 0);
    RealRay ray = ray_of(scene, column, row);
    Hit start = empty_hit(index);
    shown_at(SCENE, column, row);
    given("face", "%d, %s", index, scene->objects[scene->faces[index].object].name);
    given("n", "%s", text_of(n));
    given("v0", "%s", text_of(v0));
    given_ray(ray);

    Hit returned = start;
    bool met = meets_plane(n, v0, ray, &returned);
    for (SlipKind kind = SLIP_NONE + 1; kind < SLIP_COUNT; kind++) {
        Hit hit = start;
        bool answer = slipped(kind, n, v0, ray, &hit);
        Outcome outcome = outcome_of(answer, &hit);
        slip(&outcome, "%s", SLIPS[kind]);
    }
    Outcome theirs = outcome_of(met, &returned), ours = expected_of(n, v0, ray, start);
    compare(&theirs, &ours);
}

static void wall_ahead(void)
{
    try_face(2, 1, POSTER);
    try_face(3, 2, POSTER);
}

static void wall_from_behind(void)
{
    try_face(5, 2, WALL);
}

static void floor_below(void)
{
    try_face(4, 5, FLOOR);
}

static void ramp(void)
{
    try_face(6, 4, RAMP);
}

static void wall_behind_us(void)
{
    try_face(4, 3, BEHIND_US);
    try_face(4, 1, FLOOR);
}

static void parallel_ray(void)
{
    try_face(6, 3, FLOOR);
}

static void origin_in_the_plane(void)
{
    try_face(5, 3, EDGE_ON);
    try_face(4, 3, EDGE_ON);
}

static void every_pixel(void)
{
    const Scene *scene = scene_of(SCENE);
    for (int index = 0; index < scene->face_count; index++)
        for (int row = 0; row < scene->screen.rows; row++)
            for (int column = 0; column < scene->screen.columns; column++)
                try_face(column, row, index);
}

static const ExerciseTest TESTS[] = {
    {"wall_ahead", "A poster ahead, which faces us", wall_ahead},
    {"wall_from_behind", "A wall whose normal points away from us", wall_from_behind},
    {"floor_below", "The floor", floor_below},
    {"ramp", "A ramp", ramp},
    {"wall_behind_us", "Planes that are behind us", wall_behind_us},
    {"parallel_ray", "A ray parallel to the floor", parallel_ray},
    {"origin_in_the_plane", "A plane in which the ray starts", origin_in_the_plane},
    {"every_pixel", "Every pixel with every face", every_pixel},
    {NULL, NULL, NULL},
};

int main(int argc, char **argv)
{
    Exercise exercise = {.tests = TESTS, .pixel = student_pixel, .scene = SCENE, .columns = 135, .rows = 105};
    return exercise_main(argc, argv, &exercise);
}
