/* Fails at straight_on: whatever r.N. */
#include "trace/textbook_real.h"

static RealRay mirrored_ray(Real3 r, const Hit *hit)
{
    return (RealRay){hit->shifted, subtract(r, scale(2, hit->n))};
}
