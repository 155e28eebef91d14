/* Rays, one in each lane. */
#include "shared/compiler.cl"
#include "packet/lanes.cl"
#include "packet/vectors.cl"

typedef struct Ray {
    WideVec origin, direction;
} Ray;

/* The same in `real`. */
typedef struct RealRay {
    Vec origin, direction;
    Lanes scale; /* the largest magnitude of the direction's components */
    Vec scaled;  /* direction / scale */
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
