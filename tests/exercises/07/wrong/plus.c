/* Fails at straight_on: is added, not taken away. */
#include "trace/textbook_real.h"

static RealRay mirrored_ray(Real3 r, const Hit *hit)
{
    return (RealRay){hit->shifted, add(r, scale(2 * dot(r, hit->n), hit->n))};
}
