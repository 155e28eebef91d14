/* Fails at mirror_ahead: back where it came from. */
#include "trace/textbook_real.h"

static RealRay mirrored_ray(Real3 r, const Hit *hit)
{
    return (RealRay){hit->shifted, scale(-1, r)};
}
