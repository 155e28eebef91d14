/* Grades a picture that some program wrote. */
#include "grade/grade_picture.h"

#include "grade/slip_trace.h"
#include "trace/reference_render.h"

#include <stdlib.h>
#include <string.h>

enum { EQUAL_TRIES = 4, ROUNDED_MOST = 400 };

/* A pixel that is traced with every slip. */
typedef struct Try {
    int column, row;
    bool differs;
    Walkthrough walk; /* ours */
} Try;

typedef struct Comparing {
    const Scene *scene;
    const Image *image;
    unsigned char *ours;
    int tolerance;
    Try tries[GRADE_TRIES + EQUAL_TRIES];
    int try_count;
} Comparing;

/* --- Our picture --- */

static bool keep_band(void *user, int first_row, int rows, const unsigned char *rgb, const RenderReport *so_far,
                      Error *error)
{
    Comparing *comparing = user;
    size_t row_bytes = 3 * (size_t)comparing->image->columns;
    (void)so_far;
    (void)error;
    memcpy(comparing->ours + (size_t)first_row * row_bytes, rgb, (size_t)rows * row_bytes);
    return true;
}

static bool render(Comparing *comparing, Error *error)
{
    RenderSettings settings = {.precision = PRECISION_DOUBLE, .device = -1, .accel = ACCEL_AUTO};
    RenderReport report = {0};
    comparing->ours = malloc(3 * (size_t)comparing->image->columns * (size_t)comparing->image->rows);
    if (!comparing->ours)
        return error_memory(error, "a picture");
    return reference_render(comparing->scene, &settings, (BandSink){keep_band, comparing}, &report, error);
}

/* --- Pixels --- */

static bool near_bytes(const unsigned char *a, const unsigned char *b, int tolerance)
{
    for (int i = 0; i < 3; i++)
        if (abs(a[i] - b[i]) > tolerance)
            return false;
    return true;
}

static const unsigned char *given_at(const Comparing *comparing, int column, int row)
{
    return comparing->image->rgb + 3 * ((size_t)row * (size_t)comparing->image->columns + (size_t)column);
}

static unsigned char *ours_at(const Comparing *comparing, int column, int row)
{
    return comparing->ours + 3 * ((size_t)row * (size_t)comparing->image->columns + (size_t)column);
}

static bool differs_at(const Comparing *comparing, int column, int row)
{
    return !near_bytes(ours_at(comparing, column, row), given_at(comparing, column, row), comparing->tolerance);
}

static bool record(const Comparing *comparing, Walkthrough *walk, int column, int row, Error *error)
{
    WalkthroughRequest request = {.column = column, .row = row};
    return walkthrough_record(walk, comparing->scene, NULL, "", request, error);
}

/* Whether the pixel, traced with the steps, has the colour that was given. */
static bool try_steps(const Comparing *comparing, const SlipSteps *steps, const Walkthrough *right, bool *is,
                      Error *error)
{
    Walkthrough walk;
    bool done = slip_trace(&walk, right, steps, error);
    if (done)
        *is = near_bytes(walk.events[walk.count - 1].as.pixel.rgb,
                         given_at(comparing, right->request.column, right->request.row), comparing->tolerance);
    walkthrough_free(&walk);
    return done;
}

/* The same with a slip. One of the test of a face may be in shadow rays, too, or not. */
static bool explains(const Comparing *comparing, const Slip *slip, const Walkthrough *right, bool *is, Error *error)
{
    SlipSteps apart = slip->steps;
    apart.shadows_apart = true;
    return try_steps(comparing, &slip->steps, right, is, error) &&
           (*is || !slip->steps.test || try_steps(comparing, &apart, right, is, error));
}

/* --- Where rounding decides --- */

/* Whether some arithmetic without a slip makes the colour that was given. */
static bool rounding_explains(const Comparing *comparing, int column, int row, bool *is, Error *error)
{
    Walkthrough walk;
    bool done = record(comparing, &walk, column, row, error);
    const Slip *slip;
    *is = false;
    for (int i = 0; done && !*is && (slip = slip_number(i)); i++)
        if (slip->rounding)
            done = explains(comparing, slip, &walk, is, error);
    walkthrough_free(&walk);
    return done;
}

static long count_differing(const Comparing *comparing)
{
    long count = 0;
    for (int row = 0; row < comparing->image->rows; row++)
        for (int column = 0; column < comparing->image->columns; column++)
            count += differs_at(comparing, column, row);
    return count;
}

/* Pixels that rounding explains become equal. Where many differ it is not rounding. */
static bool forgive_rounding(Comparing *comparing, GradePicture *grade, Error *error)
{
    grade->differing = count_differing(comparing);
    if (grade->differing > ROUNDED_MOST)
        return true;
    for (int row = 0; row < comparing->image->rows; row++)
        for (int column = 0; column < comparing->image->columns; column++) {
            bool is;
            if (!differs_at(comparing, column, row))
                continue;
            if (!rounding_explains(comparing, column, row, &is, error))
                return false;
            if (!is)
                continue;
            memcpy(ours_at(comparing, column, row), given_at(comparing, column, row), 3);
            grade->rounded++;
            grade->differing--;
        }
    return true;
}

/* --- The first difference --- */

static bool find_in_tile(const Comparing *comparing, GradePicture *grade, int left, int top)
{
    for (int row = top; row < top + GRADE_TILE && row < comparing->image->rows; row++)
        for (int column = left; column < left + GRADE_TILE && column < comparing->image->columns; column++)
            if (differs_at(comparing, column, row)) {
                grade->column = column;
                grade->row = row;
                memcpy(grade->expected, ours_at(comparing, column, row), 3);
                memcpy(grade->given, given_at(comparing, column, row), 3);
                return true;
            }
    return false;
}

static bool find_first(const Comparing *comparing, GradePicture *grade)
{
    for (int top = 0; top < comparing->image->rows; top += GRADE_TILE)
        for (int left = 0; left < comparing->image->columns; left += GRADE_TILE)
            if (find_in_tile(comparing, grade, left, top))
                return true;
    return false;
}

/* --- Causes --- */

static bool add_try(Comparing *comparing, int column, int row, Error *error)
{
    Try *one = &comparing->tries[comparing->try_count++];
    one->column = column;
    one->row = row;
    one->differs = differs_at(comparing, column, row);
    return record(comparing, &one->walk, column, row, error);
}

/* Adds `count` pixels that differ, or that do not, spread evenly over all of their kind. */
static bool add_tries(Comparing *comparing, bool differing, long all, int count, Error *error)
{
    long number = 0, taken = 0;
    for (int row = 0; row < comparing->image->rows; row++)
        for (int column = 0; column < comparing->image->columns; column++) {
            if (differs_at(comparing, column, row) != differing)
                continue;
            if (taken < count && number == all * taken / count) {
                taken++;
                if (!add_try(comparing, column, row, error))
                    return false;
            }
            number++;
        }
    return true;
}

static int smaller(long a, int b)
{
    return a < b ? (int)a : b;
}

static bool is_better(const GradePictureCause *a, const GradePictureCause *b)
{
    return a->explained > b->explained || (a->explained == b->explained && a->kept > b->kept);
}

/* The best causes stay, in order. */
static void keep_cause(GradePicture *grade, GradePictureCause cause)
{
    int at = grade->cause_count;
    while (at > 0 && is_better(&cause, &grade->causes[at - 1]))
        at--;
    if (at == GRADE_CAUSES)
        return;
    grade->cause_count += grade->cause_count < GRADE_CAUSES;
    for (int i = grade->cause_count - 1; i > at; i--)
        grade->causes[i] = grade->causes[i - 1];
    grade->causes[at] = cause;
}

static bool find_causes(const Comparing *comparing, GradePicture *grade, Error *error)
{
    const Slip *slip;
    for (int i = 0; (slip = slip_number(i)); i++) {
        GradePictureCause cause = {.slip = slip};
        for (int k = 0; k < comparing->try_count; k++) {
            const Try *one = &comparing->tries[k];
            bool is = false;
            if (!explains(comparing, slip, &one->walk, &is, error))
                return false;
            *(one->differs ? &cause.explained : &cause.kept) += is;
        }
        if (2 * cause.explained > grade->tried)
            keep_cause(grade, cause);
    }
    while (grade->cause_count > 0 && is_better(&grade->causes[0], &grade->causes[grade->cause_count - 1]))
        grade->cause_count--;
    return true;
}

bool grade_picture_make(GradePicture *grade, const Scene *scene, const Image *image, int tolerance, Error *error)
{
    Comparing comparing = {.scene = scene, .image = image, .tolerance = tolerance};
    *grade = (GradePicture){.differing = 0};
    bool done = render(&comparing, error) && forgive_rounding(&comparing, grade, error);
    if (done && find_first(&comparing, grade)) {
        long equal = (long)image->columns * image->rows - grade->differing;
        grade->tried = smaller(grade->differing, GRADE_TRIES);
        grade->equal_tried = smaller(equal, EQUAL_TRIES);
        done = add_tries(&comparing, true, grade->differing, grade->tried, error) &&
               add_tries(&comparing, false, equal, grade->equal_tried, error) && find_causes(&comparing, grade, error);
    }
    for (int i = 0; i < comparing.try_count; i++)
        walkthrough_free(&comparing.tries[i].walk);
    free(comparing.ours);
    return done;
}
