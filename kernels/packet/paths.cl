/* Paths of rays, from the eye over mirrors. */
#include "shared/compiler.cl"
#include "shared/layout.h"
#include "shared/precision.cl"
#include "shared/skips.h"
#include "packet/bytes.cl"
#include "packet/lanes.cl"
#include "packet/rays.cl"
#include "packet/vectors.cl"
#include "packet/world.cl"

/* The rays of a packet on their way, and what they have brought so far. */
typedef struct Path {
    WideVec apex; /* the image of the eye in the mirrors so far, from which the rays seem to come */
    Mask active, left;
    Vec total;
    Lanes weight;
} Path;

/* Paths at their beginning, in the eye. */
INLINE void begin_paths(Path *paths, const Ray *rays)
{
    EACH_PACKET(p) {
        paths[p].apex = rays[p].origin;
        paths[p].left = (Mask)-1;
        paths[p].total = vec(0, 0, 0);
        paths[p].weight = (Lanes)1;
    }
}

/* The lanes all of whose further hits together could not change a byte of the picture: those whose bytes are the same with the
 * most that can come, at that weight. That is known where a path is its pixel's only one. */
INLINE Mask too_weak(const World *world, Vec total, Lanes weight)
{
#if defined(LINEAR) || ADAPTIVE
    return (Mask)0;
#else
    if (!MAY_SKIP(world->parameters, SKIP_WEAK_BOUNCE) || world->parameters->grid > 1)
        return (Mask)0;
    Lanes most = weight * (Lanes)world->view[VIEW_BRIGHTEST];
    const real rounded = 1 + 256 * REAL_ROUNDING; /* no sum of up to PATH_MAX terms is rounded up by more */
    IntLanes red = IS(colour_to_byte(total.x) == colour_to_byte((total.x + most) * rounded));
    IntLanes green = IS(colour_to_byte(total.y) == colour_to_byte((total.y + most) * rounded));
    IntLanes blue = IS(colour_to_byte(total.z) == colour_to_byte((total.z + most) * rounded));
    return INTS_TO_MASK(red & green & blue);
#endif
}

/* Ends such paths. reflection: of the faces they are at. */
INLINE void drop_weak(const World *world, Path *path, Lanes reflection)
{
    if (!ANY(path->active))
        return;
    Mask weak = path->active & too_weak(world, path->total, path->weight * reflection);
    world->counters[COUNT_SKIPPED + SKIP_WEAK_BOUNCE] += mask_count(weak);
    path->active &= ~weak;
}
