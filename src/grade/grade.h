/* Grades a walkthrough that some program wrote: the first difference from ours, and the slips that would make it. Every
 * slip is tried, by tracing the pixel with it; one that leads past the difference is a likely cause. */
#ifndef RECTRAY_GRADE_H
#define RECTRAY_GRADE_H

#include "grade/difference.h"
#include "grade/slip.h"

enum { GRADE_CAUSES = 16 };

/* The defaults. */
#define GRADE_ABSOLUTE 1e-4
#define GRADE_RELATIVE 1e-4

typedef struct GradeCause {
    const Slip *slip;
    DifferenceKind rest; /* what differs still, with the slip: DIFFERENCE_NONE where it explains all */
    int events;          /* so many events given are as with the slip, up to there */
} GradeCause;

typedef struct Grade {
    const Given *given; /* borrowed */
    Walkthrough walk;   /* ours */
    Expected expected;
    Difference difference;
    GradeCause causes[GRADE_CAUSES]; /* the first of those that explain most, in the order of the lists */
    int cause_count;
    int more_causes; /* so many more explain as much */
    bool same;       /* no difference, or one that rounding makes */
} Grade;

/* Free the grade also after a failure: of memory, or a value of a wrong type in what was given. */
bool grade_make(Grade *grade, const Scene *scene, const char *scene_name, const Given *given,
                WalkthroughRequest request, Tolerance tolerance, Error *error);
void grade_free(Grade *grade);

#endif
