/* The textbook tracer with the student's file in place of one of its steps: `run` makes a header of that step's name
 * that includes the student's file, and puts its folder before src/. Our own tracer is in the library, too, so this
 * one gets other names. A test includes this file once. */
#ifndef EXERCISE_TEXTBOOK_H
#define EXERCISE_TEXTBOOK_H

#include "exercises/exercise.h"

#define textbook_pixel student_pixel
#define textbook_test student_test
#include "trace/textbook.c" /* NOLINT(bugprone-suspicious-include): with the student's step in it */

/* A number that no formula gives: where it comes back, nothing was filled in. */
static const Real NOTHING = (Real)NAN;

/* A hit in which nothing was filled in. */
static Hit empty_hit(int face)
{
    Real3 nothing = {NOTHING, NOTHING, NOTHING};
    return (Hit){.face = face,
                 .n_dot_r = NOTHING,
                 .n_dot_o_plus_d = NOTHING,
                 .t = NOTHING,
                 .edge = {NOTHING, NOTHING, NOTHING, NOTHING},
                 .p = nothing,
                 .n = nothing,
                 .shifted = nothing};
}

/* "(1, 2, 3)". */
static const char *text_of(Real3 a)
{
    return vector_text(doubles(a));
}

static Textbook textbook_of(const Scene *scene)
{
    static RenderReport report;
    return (Textbook){.scene = scene, .shift = SCENE_SHIFT, .report = &report};
}

/* The ray through the middle of a pixel. */
static RealRay ray_of(const Scene *scene, int column, int row)
{
    return camera_ray(view_of(scene), column, row, 0, 0).ray;
}

static Real3 normal_of(const Scene *scene, int face)
{
    return rounded(scene->planes[face].normal);
}

static void given_face(const Scene *scene, int index)
{
    static const char *const NAMES[] = {"v[0]", "v[1]", "v[2]", "v[3]"};
    const Face *face = &scene->faces[index];
    given("face", "%d, %s", index, scene->objects[face->object].name);
    for (int k = 0; k < face->vertex_count; k++)
        given(NAMES[k], "%s", text_of(vertex(face, k)));
    given("N", "%s", text_of(normal_of(scene, index)));
}

static void given_ray(RealRay ray)
{
    given("ray.o", "%s", text_of(ray.o));
    given("ray.r", "%s", text_of(ray.r));
}

#endif
