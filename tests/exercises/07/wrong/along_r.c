/* Fails at straight_on: r and N are exchanged. */
#include "trace/textbook_real.h"

static RealRay mirrored_ray(Real3 r, const Hit *hit)
{
    return (RealRay){hit->shifted, subtract(r, scale(2 * dot(r, hit->n), r))};
}
