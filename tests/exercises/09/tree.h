/* What the student's file of exercise 9 works with besides src/. */
#ifndef EXERCISE_TREE_H
#define EXERCISE_TREE_H

#include "trace/kdtree.h"
#include "trace/traversal.h"

#include <math.h>

/* A plane that cuts a box in two: where the coordinate `axis` is `position`. */
typedef struct Cut {
    int axis;
    float position;
    int low_count, high_count; /* the faces on each side; a face may be on both */
    double cost;               /* in face tests */
} Cut;

#endif
