/* Fails at near_and_far: the largest t. */
#include "trace/textbook_face.h"

static Hit nearest_hit(const Textbook *textbook, RealRay ray)
{
    Hit nearest = {.face = -1, .t = 0}, hit;
    for (int i = 0; i < textbook->scene->face_count; i++)
        if (hits_face(textbook, i, ray, nearest.t, &hit) && hit.t > nearest.t)
            nearest = hit;
    return nearest;
}
