/* Rays, a lane each. */
#include "shared/compiler.cl"
#include "packet/lanes.cl"
#include "packet/vectors.cl"

typedef struct Ray {
    WideVec origin, direction;
} Ray;

/* A ray in `real`. */
typedef struct RealRay {
    Vec origin, direction;
    Vec scaled;  /* the direction divided by the largest magnitude of its components, which is */
    Lanes scale;
} RealRay;

INLINE RealRay real_ray(Vec origin, Vec direction)
{
    RealRay l;
    l.origin = origin;
    l.direction = direction;
    l.scale = vec_largest(direction);
    l.scaled = vec_scale(1 / l.scale, direction);
    return l;
}
