/* Fails at straight_on: once, not twice. */
#include "trace/textbook_real.h"

static RealRay mirrored_ray(Real3 r, const Hit *hit)
{
    return (RealRay){hit->shifted, subtract(r, scale(dot(r, hit->n), hit->n))};
}
