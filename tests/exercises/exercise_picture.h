/* The student's picture beside ours. */
#ifndef EXERCISE_PICTURE_H
#define EXERCISE_PICTURE_H

#include "exercises/exercise.h"

typedef struct PictureDifference {
    int differing;   /* pixels with a channel that is more than 2 of 255 off */
    bool wrong;      /* more than 1 pixel in 200 is */
    int column, row; /* of the first */
    unsigned char returned[3], expected[3];
} PictureDifference;

/* Renders both, and writes them side by side as a PNG: the student's on the left. */
bool exercise_picture(const Scene *scene, const Exercise *exercise, const char *path, PictureDifference *found,
                      Error *error);

#endif
