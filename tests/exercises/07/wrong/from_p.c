/* Fails at straight_on: starts at P. */
#include "trace/textbook_real.h"

static RealRay mirrored_ray(Real3 r, const Hit *hit)
{
    return (RealRay){hit->p, subtract(r, scale(2 * dot(r, hit->n), hit->n))};
}
