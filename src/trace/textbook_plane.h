/* Step 3 of the textbook tracer: where a ray meets the plane of a face. */
#ifndef RECTRAY_TEXTBOOK_PLANE_H
#define RECTRAY_TEXTBOOK_PLANE_H

#include "trace/textbook_real.h"

/* Is the plane with the normal N through the point v0 met at t > 0? Fills N.R, N.O + D and t of the hit; where the ray
 * is parallel, no t. The plane is A x + B y + C z + D = 0, and N = (A, B, C). */
static bool meets_plane(Real3 n, Real3 v0, RealRay ray, Hit *hit)
{
    Real d = -dot(n, v0);
    hit->n_dot_r = dot(n, ray.r);
    hit->n_dot_o_plus_d = dot(n, ray.o) + d;
    if (hit->n_dot_r == 0)
        return false; /* parallel */
    hit->t = -hit->n_dot_o_plus_d / hit->n_dot_r;
    return hit->t > 0; /* else behind the origin */
}

#endif
