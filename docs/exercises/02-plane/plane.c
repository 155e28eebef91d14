/* Exercise 2: where does a ray meet a plane? The README beside this file tells the task.
 *
 * What you may use, all of it short, in src/trace/textbook_real.h:
 *     Real                                     a number, a double here
 *     Real3                                    a point or a vector, with .x, .y and .z
 *     RealRay                                  a ray from the point .o in the direction .r: P(t) = O + t R
 *     add(a, b), subtract(a, b), scale(s, a)   a + b, a - b, s a
 *     dot(a, b)                                a.b
 */
#include "trace/textbook_real.h"

/* Does the ray meet the plane with the unit normal n through the point v0, ahead of its origin?
 *
 * The plane is N.P + D = 0. Fill
 *     hit->n_dot_r          N.R
 *     hit->n_dot_o_plus_d   N.O + D
 *     hit->t                the t at which the ray is in the plane. A ray parallel to the plane has none: leave it
 * Give back true if there is a t, and it is greater than 0. */
static bool meets_plane(Real3 n, Real3 v0, RealRay ray, Hit *hit)
{
    /* Your lines. */
    return false;
}
