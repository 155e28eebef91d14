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

#endif
