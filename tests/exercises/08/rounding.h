/* What the student's file of exercise 8 may use besides src/. */
#ifndef EXERCISE_ROUNDING_H
#define EXERCISE_ROUNDING_H

#include "scene/geometry.h"

#include <math.h>

#define ROUNDING 0x1p-53

/* A number, and how far it may be from the true one. */
typedef struct Distance {
    double value, error;
} Distance;

/* The sign of R.((A - O) x (B - O)), exact. */
int exact_side_of_edge(Vec3 o, Vec3 r, Vec3 a, Vec3 b);

#endif
