/* Fails at last_face: the last face of the scene. */
#include "trace/textbook_face.h"

static Hit nearest_hit(const Textbook *textbook, RealRay ray)
{
    Hit nearest = {.face = -1, .t = (Real)HUGE_VAL}, hit;
    for (int i = 0; i < textbook->scene->face_count - 1; i++)
        if (hits_face(textbook, i, ray, nearest.t, &hit) && hit.t < nearest.t)
            nearest = hit;
    return nearest;
}
