/* Fails at straight_on: 2 (r.N) N - r. */
#include "trace/textbook_real.h"

static RealRay mirrored_ray(Real3 r, const Hit *hit)
{
    return (RealRay){hit->shifted, subtract(scale(2 * dot(r, hit->n), hit->n), r)};
}
