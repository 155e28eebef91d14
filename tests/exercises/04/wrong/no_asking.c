/* Fails at one_face: hits_face answers. */
#include "trace/textbook_face.h"

static Hit nearest_hit(const Textbook *textbook, RealRay ray)
{
    Hit nearest = {.face = -1, .t = (Real)HUGE_VAL};
    for (int i = 0; i < textbook->scene->face_count; i++) {
        Hit hit = {.face = i};
        hits_face(textbook, i, ray, nearest.t, &hit);
        if (hit.t > 0 && hit.t < nearest.t)
            nearest = hit;
    }
    return nearest;
}
