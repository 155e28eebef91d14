/* Fails at straight_on: the direction stays r. */
#include "trace/textbook_real.h"

static RealRay mirrored_ray(Real3 r, const Hit *hit)
{
    return (RealRay){hit->shifted, r};
}
