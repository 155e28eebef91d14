/* Exercise 4: which face does a ray meet first? The README beside this file tells the task.
 *
 * What you may use:
 *     textbook->scene->face_count     how many faces there are; they are counted from 0
 *     hits_face(textbook, i, ray, t, &hit)
 *                                     does the ray hit face i? Where it does, `hit` is filled. t is the smallest so
 *                                     far, or HUGE_VAL; it is only told in walkthroughs, and changes no answer
 *     Hit                             a struct with .face, .t and more: src/trace/textbook_real.h
 *     HUGE_VAL                        larger than any number
 */
#include "trace/textbook_face.h"

/* The hit with the smallest t of all faces that the ray hits, with all that hits_face has filled in.
 *
 * Where two faces have the same t, the one that comes first in the scene counts.
 * Where no face is hit, the face of what you give back is -1. */
static Hit nearest_hit(const Textbook *textbook, RealRay ray)
{
    Hit nearest = {.face = -2};
    /* Your lines. */
    return nearest;
}
