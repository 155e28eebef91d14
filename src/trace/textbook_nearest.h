/* Step 5 of the textbook tracer: the face that a ray meets first. */
#ifndef RECTRAY_TEXTBOOK_NEAREST_H
#define RECTRAY_TEXTBOOK_NEAREST_H

#include "trace/textbook_face.h"

/* The hit with the smallest t; of equal ones, the first in the file. Its face is -1 where no face is hit. */
static Hit nearest_hit(const Textbook *textbook, RealRay ray)
{
    Hit nearest = {.face = -1, .t = (Real)HUGE_VAL}, hit;
    for (int i = 0; i < textbook->scene->face_count; i++)
        if (hits_face(textbook, i, ray, nearest.t, &hit) && hit.t < nearest.t)
            nearest = hit;
    return nearest;
}

#endif
