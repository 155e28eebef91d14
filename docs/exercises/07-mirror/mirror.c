/* Exercise 7: where does a ray go that meets a mirror? The README beside this file tells the task.
 *
 * What you may use, all of it short, in src/trace/textbook_real.h:
 *     Real                                     a number, a double here
 *     Real3                                    a point or a vector, with .x, .y and .z
 *     RealRay                                  a ray from the point .o in the direction .r
 *     add(a, b), subtract(a, b), scale(s, a)   a + b, a - b, s a
 *     dot(a, b)                                a.b
 */
#include "trace/textbook_real.h"

/* The ray that leaves the mirror.
 *
 * r is the unit direction of the ray that arrives. The mirror's unit normal on the side that it comes from is hit->n.
 * The mirrored ray starts at the shifted point, hit->shifted. Its direction is a unit vector, too. */
static RealRay mirrored_ray(Real3 r, const Hit *hit)
{
    RealRay ray = {0};
    /* Your lines. */
    return ray;
}
