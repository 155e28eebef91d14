/* Fails at parallel_ray: before the division. */
#include "trace/textbook_real.h"

static bool meets_plane(Real3 n, Real3 v0, RealRay ray, Hit *hit)
{
    Real d = -dot(n, v0);
    hit->n_dot_r = dot(n, ray.r);
    hit->n_dot_o_plus_d = dot(n, ray.o) + d;
    hit->t = -hit->n_dot_o_plus_d / hit->n_dot_r;
    return hit->t > 0;
}
