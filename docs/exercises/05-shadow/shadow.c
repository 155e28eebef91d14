/* Exercise 5: does a face stand between a point and a light? The README beside this file tells the task.
 *
 * What you may use:
 *     Real, Real3, RealRay           numbers, points and rays, in src/trace/textbook_real.h
 *     add(a, b), subtract(a, b), scale(s, a), dot(a, b)
 *     textbook->scene->face_count    how many faces there are; they are counted from 0
 *     rounded(textbook->scene->planes[i].normal)
 *                                    the unit normal N of face i
 *     textbook->shift                how far a point is shifted off its face
 *     hits_occluder(textbook, i, ray, &hit)
 *                                    does the ray hit face i at t > 0? Where it does, hit.t is filled, and more
 */
#include "trace/textbook_face.h"

/* The ray has hit the face hit->face at the point hit->p, and hit->n_dot_r is N.R. Fill
 *     hit->n         the normal on the side that the ray came from: N or -N
 *     hit->shifted   S, the point moved off the face by the shift, along hit->n */
static void place_hit(const Textbook *textbook, Hit *hit)
{
    /* Your lines. */
}

/* A face between the shifted point hit->shifted and the light: the ray from there to the light hits it at 0 < t < 1,
 * where t = 1 is the light. Give back its number; of several faces, that of the first one. Give back -1 if there is
 * none. */
static int face_between(const Textbook *textbook, const Hit *hit, Real3 light)
{
    /* Your lines. */
    return -1;
}
