/* Fails at near_and_far: the last face of the file. */
#include "trace/textbook_face.h"

static Hit nearest_hit(const Textbook *textbook, RealRay ray)
{
    Hit nearest = {.face = -1, .t = (Real)HUGE_VAL}, hit;
    for (int i = 0; i < textbook->scene->face_count; i++)
        if (hits_face(textbook, i, ray, nearest.t, &hit))
            nearest = hit;
    return nearest;
}
