/* Step 9 of the textbook tracer: the ray that leaves a mirror. */
#ifndef RECTRAY_TEXTBOOK_MIRROR_H
#define RECTRAY_TEXTBOOK_MIRROR_H

#include "trace/textbook_real.h"

/* R' = r - 2 (r.N) N from the shifted point, where r is the unit direction of the ray that arrives. */
static RealRay mirrored_ray(Real3 r, const Hit *hit)
{
    return (RealRay){hit->shifted, subtract(r, scale(2 * dot(r, hit->n), hit->n))};
}

#endif
