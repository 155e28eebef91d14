/* What the tests of exercise 8 share: exact arithmetic that judges, and random inputs. Included by test.c alone. */
#ifndef EXERCISE_JUDGE_H
#define EXERCISE_JUDGE_H

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

static int sign_of(double x)
{
    return (x > 0) - (x < 0);
}

#endif
