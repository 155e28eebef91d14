/* Paths: what becomes of a ray from the eye, from mirror to mirror. */
#include "shared/compiler.cl"
#include "shared/layout.h"
#include "shared/precision.cl"
#include "shared/skips.h"
#include "packet/bytes.cl"
#include "packet/lanes.cl"
#include "packet/rays.cl"
#include "packet/vectors.cl"
#include "packet/world.cl"

/* The paths of a packet's rays: where they are, and what they have brought so far. */
typedef struct Path {
    WideVec apex; /* the image of the eye in the mirrors so far, from which the rays seem to come */
    Mask active;  /* the lanes whose paths have not ended */
    Mask from;    /* the face that each ray leaves; -1: none */
    Vec total;    /* the colour so far */
    Lanes weight; /* of what is to come: the product of the mirrors' reflections */
} Path;

/* Paths begin in the eye. The caller has set which ones are active. */
INLINE void begin_paths(Path *paths, const Ray *rays)
{
    EACH_PACKET(p) {
        paths[p].apex = rays[p].origin;
        paths[p].from = (Mask)-1;
        paths[p].total = vec(0, 0, 0);
        paths[p].weight = (Lanes)1;
    }
}

/* Adds a colour to the totals of those lanes. */
INLINE void path_add(Path *path, Mask lanes, Vec colour)
{
    path->total = vec_select(lanes, vec_add(path->total, vec_scale(path->weight, colour)), path->total);
}

/* The lanes whose further hits cannot change a byte of the picture, even all of them together: with the most that can
 * come, at that weight, the bytes are the same. A pixel of several paths decides nothing yet: its bytes are those of
 * their mean. The host switches the skip off where there are other such pixels (adaptive sampling), or no bytes
 * (LINEAR). */
INLINE Mask too_weak(const World *world, Vec total, Lanes weight)
{
    if (!MAY_SKIP(world->parameters, SKIP_WEAK_BOUNCE) || world->parameters->grid > 1)
        return (Mask)0;
    Lanes most = weight * (Lanes)world->view[VIEW_BRIGHTEST];
    const real rounded = 1 + 256 * REAL_ROUNDING; /* no sum of up to PATH_MAX terms is rounded up by more */
    IntLanes red = IS(colour_to_byte(total.x) == colour_to_byte((total.x + most) * rounded));
    IntLanes green = IS(colour_to_byte(total.y) == colour_to_byte((total.y + most) * rounded));
    IntLanes blue = IS(colour_to_byte(total.z) == colour_to_byte((total.z + most) * rounded));
    return INTS_TO_MASK(red & green & blue);
}

/* Ends such paths. reflection: of the faces that they have hit. */
INLINE void drop_weak(const World *world, Path *path, Lanes reflection)
{
    if (!ANY(path->active))
        return;
    Mask weak = path->active & too_weak(world, path->total, path->weight * reflection);
    world->counters[COUNT_SKIPPED + SKIP_WEAK_BOUNCE] += mask_count(weak);
    path->active &= ~weak;
}
