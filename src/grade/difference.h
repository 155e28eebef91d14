/* The first place at which a walkthrough that was given differs from what is expected. */
#ifndef RECTRAY_DIFFERENCE_H
#define RECTRAY_DIFFERENCE_H

#include "grade/expected.h"
#include "grade/given.h"

typedef struct Tolerance {
    double absolute, relative; /* a number may differ by absolute + relative |ours| */
} Tolerance;

/* In which units a slip gives colours and bytes. 1: as we do. */
typedef struct Units {
    double colour, byte;
} Units;

typedef enum DifferenceKind {
    DIFFERENCE_NONE,
    DIFFERENCE_VALUE,   /* a member has another value */
    DIFFERENCE_EVENT,   /* another event */
    DIFFERENCE_MISSING, /* an event is expected, and nothing is given */
    DIFFERENCE_SURPLUS, /* an event is given, and nothing is expected */
} DifferenceKind;

typedef struct Difference {
    DifferenceKind kind;
    int events;                            /* so many events given are as expected before it */
    int members;                           /* and so many numbers and words */
    int hit;                               /* the number of P1, P2, ... at which it is; 0 before the first */
    EventKind expected_event, given_event; /* EVENT_KIND_COUNT: none */
    const char *member;                    /* of a value */
    const cJSON *expected, *given;         /* the two values */
    const cJSON *object;                   /* the event given; NULL: none */
} Difference;

/* Compares. Kinds of events that are never given are not asked for, hits excepted. False where a value has not the type
 * that it must have: an ERROR_INPUT with its place. */
bool difference_find(Difference *difference, const Expected *expected, const Given *given, Tolerance tolerance,
                     Units units);

#endif
