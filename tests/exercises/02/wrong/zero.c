/* Fails at origin_in_the_plane: t = 0 counts. */
#include "trace/textbook_real.h"

static bool meets_plane(Real3 n, Real3 v0, RealRay ray, Hit *hit)
{
    Real d = -dot(n, v0);
    hit->n_dot_r = dot(n, ray.r);
    hit->n_dot_o_plus_d = dot(n, ray.o) + d;
    if (hit->n_dot_r == 0)
        return false;
    hit->t = -hit->n_dot_o_plus_d / hit->n_dot_r;
    return hit->t >= 0;
}
