/* Grades a picture that some program wrote: the first pixel that differs from ours, and the slips that would make it.
 * Some pixels that differ, and some that do not, are traced with every slip. */
#ifndef RECTRAY_GRADE_PICTURE_H
#define RECTRAY_GRADE_PICTURE_H

#include "grade/grade.h"
#include "picture/image.h"

enum { GRADE_TILE = 16, GRADE_TRIES = 12 };

typedef struct GradePictureCause {
    const Slip *slip;
    int explained; /* so many of the differing pixels that were tried have the slip's colour */
    int kept;      /* and so many of the equal ones */
} GradePictureCause;

typedef struct GradePicture {
    long differing, rounded; /* pixels; rounded: where rounding decides, which are not among the differing ones */
    int column, row;         /* the first that differs, in the first tile of 16 x 16 that has one */
    unsigned char expected[3], given[3];
    int tried, equal_tried; /* pixels that were traced with every slip */
    GradePictureCause causes[GRADE_CAUSES];
    int cause_count;
} GradePicture;

/* The picture has the scene's columns and rows. A byte may differ by `tolerance`. Failures are of memory. */
bool grade_picture_make(GradePicture *grade, const Scene *scene, const Image *image, int tolerance, Error *error);

#endif
