/* Faces against frusta: what the four corner rays say of all rays between them.
 *
 * A ray between the corners is a sum of the corner rays, with weights between 0 and 1. Edge functions and 1/t are
 * linear in a ray. So what holds at all four corners holds for each ray between them (Reshetov, Soupikov, Hurley,
 * "Multi-Level Ray Tracing Algorithm", 2005; docs/bounds.md, section 11).
 *
 *     evaluate the edge functions of the face at the corners, four edges at once
 *     all corners are outside of one edge:   no ray hits the face
 *     all corners are inside of every edge:  each ray hits the face
 *
 * It costs four rays, and it stands for the 64 of a tile or the 1024 of a block. */
#include "shared/compiler.cl"
#include "shared/layout.h"
#include "shared/precision.cl"
#include "packet/apex.cl"
#include "packet/camera.cl"
#include "packet/lanes.cl"
#include "packet/nearest.cl"
#include "packet/tree.cl"
#include "packet/vectors.cl"
#include "packet/window.cl"
#include "packet/world.cl"

/* A search that has met more faces than this gives up: where there are so many, one of them hardly covers all the
 * others. */
enum { FRUSTUM_BUDGET = 24 };

/* The length of the longest corner ray; those between are no longer. A corner may lie outside of the picture, and its
 * ray be longer than all rays in the picture. */
INLINE real longest_of(const Frustum *c)
{
    real4 x = vload4(0, c->x), y = vload4(0, c->y), z = vload4(0, c->z);
    return sqrt(most_of(x * x + y * y + z * z));
}

/* The rays between the corners are OUTSIDE of the face, or it COVERS them all, or neither is certain. */
typedef enum Coverage { OUTSIDE, PARTIAL, COVERS } Coverage;

/* error: the bound of an edge function's error. It COVERS only what passes inside of all edges by more than
 * `inside`. */
INLINE Coverage classify_face(const FaceSetup *f, const Frustum *c, real error, real inside)
{
    if (!(error < (real)1e30f))
        return PARTIAL; /* nothing below overflows, so there is no NaN */
    real4 x = vload4(0, f->x), y = vload4(0, f->y), z = vload4(0, f->z);
    real4 low = fma((real4)c->x[0], x, fma((real4)c->y[0], y, c->z[0] * z)), high = low;
    for (int i = 1; i < 4; i++) {
        real4 edge = fma((real4)c->x[i], x, fma((real4)c->y[i], y, c->z[i] * z));
        low = LESSER(edge, low);
        high = GREATER(edge, high);
    }
    return least_of(high) < -error ? OUTSIDE : least_of(low) > inside ? COVERS : PARTIAL;
}

/* 1/t at the corners. */
INLINE real4 frustum_depths(const FaceSetup *f, const Frustum *c)
{
    return fma(vload4(0, c->x), (real4)f->nx, fma(vload4(0, c->y), (real4)f->ny, vload4(0, c->z) * f->nz));
}

/* The apex of a frustum from the image of the eye after so many mirrors. */
INLINE Apex apex_of_image(const World *world, const Camera *camera, const Frustum *corners, int bounces)
{
    real far = (real)magnitudes_of(camera->eye) + world->view[VIEW_FARTHEST];
    real spread = (real)bounces * ((real)(256 * WIDE_ROUNDING) * far + 4 * SHIFT_FLOOR);
    real length = GREATER(world->view[VIEW_LENGTH], longest_of(corners)) * (1 + 8 * REAL_ROUNDING);
    return apex_at(camera->eye, spread, length);
}

INLINE Traversal begin_in_frustum(const World *world, const Apex *a, const Frustum *corners)
{
    RayBounds all = bounds_of_frustum(a, corners, 0);
    return begin_traversal(world, &all);
}
