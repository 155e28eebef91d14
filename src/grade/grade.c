/* Grades a walkthrough that some program wrote. */
#include "grade/grade.h"

#include "grade/slip_trace.h"

#include <limits.h>

/* How far a comparison came. */
static int progress(const Difference *difference)
{
    return difference->kind == DIFFERENCE_NONE ? INT_MAX : difference->members;
}

static bool try_steps(const Grade *grade, const Slip *slip, const SlipSteps *steps, Tolerance tolerance,
                      Difference *difference, Error *error)
{
    Units units = {slip->unit > 0 ? slip->unit : 1, slip->byte_unit > 0 ? slip->byte_unit : 1};
    Walkthrough walk;
    Expected expected = {.count = 0};
    bool done = slip_trace(&walk, &grade->walk, steps, error) && expected_make(&expected, &walk, error) &&
                difference_find(difference, &expected, grade->given, tolerance, units);
    expected_free(&expected);
    walkthrough_free(&walk);
    return done;
}

/* A slip of the test of a face may be in shadow rays, too, or not. */
static bool try_slip(const Grade *grade, const Slip *slip, Tolerance tolerance, Difference *difference, Error *error)
{
    SlipSteps apart = slip->steps;
    Difference other;
    if (!try_steps(grade, slip, &slip->steps, tolerance, difference, error))
        return false;
    if (!slip->steps.test || difference->kind == DIFFERENCE_NONE)
        return true;
    apart.shadows_apart = true;
    if (!try_steps(grade, slip, &apart, tolerance, &other, error))
        return false;
    *difference = progress(&other) > progress(difference) ? other : *difference;
    return true;
}

static void keep_cause(Grade *grade, GradeCause cause)
{
    if (grade->cause_count < GRADE_CAUSES)
        grade->causes[grade->cause_count++] = cause;
    else
        grade->more_causes++;
}

/* Keeps the causes that come farthest, and farther than the right steps do. */
static bool find_causes(Grade *grade, Tolerance tolerance, Error *error)
{
    int best = progress(&grade->difference) + 1;
    const Slip *slip;
    for (int i = 0; (slip = slip_number(i)); i++) {
        Difference rest;
        if (!try_slip(grade, slip, tolerance, &rest, error))
            return false;
        if (progress(&rest) < best)
            continue;
        if (progress(&rest) > best)
            grade->cause_count = grade->more_causes = 0;
        best = progress(&rest);
        keep_cause(grade, (GradeCause){slip, rest.kind, rest.events});
    }
    return true;
}

/* Arithmetic that rounds otherwise makes all of what was given. */
static bool is_rounding(const Grade *grade)
{
    for (int i = 0; i < grade->cause_count; i++)
        if (grade->causes[i].slip->rounding && grade->causes[i].rest == DIFFERENCE_NONE)
            return true;
    return false;
}

bool grade_make(Grade *grade, const Scene *scene, const char *scene_name, const Given *given,
                WalkthroughRequest request, Tolerance tolerance, Error *error)
{
    *grade = (Grade){.given = given};
    bool done = walkthrough_record(&grade->walk, scene, NULL, scene_name, request, error) &&
                expected_make(&grade->expected, &grade->walk, error) &&
                difference_find(&grade->difference, &grade->expected, given, tolerance, (Units){1, 1});
    grade->same = done && grade->difference.kind == DIFFERENCE_NONE;
    if (!done || grade->same)
        return done;
    done = find_causes(grade, tolerance, error);
    grade->same = is_rounding(grade);
    return done;
}

void grade_free(Grade *grade)
{
    expected_free(&grade->expected);
    walkthrough_free(&grade->walk);
    *grade = (Grade){.cause_count = 0};
}
