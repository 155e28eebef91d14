/* Tests of side_of_edge. Included by test.c alone, after the student's file. */
#ifndef EXERCISE_SIDES_H
#define EXERCISE_SIDES_H

#include "exercises/08/judge.h"

static double rounded_side(Vec3 o, Vec3 r, Vec3 a, Vec3 b)
{
    return vec3_dot(r, vec3_cross(vec3_sub(a, o), vec3_sub(b, o)));
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

#endif
