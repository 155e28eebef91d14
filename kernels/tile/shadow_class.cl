/* How much of the part of a face that a window shows lies in the shadow of a light.
 *
 *     the corner rays meet the face's plane in four points: all points that the window shows lie between them
 *     for each face between the light and these points, seen from the light
 *         it is outside, or beyond the points:       go on
 *         it covers them all, and lies before them:  SHADOWED
 *         otherwise:                                 PARTLY_SHADOWED, as far as four rays can show
 *     no such face: LIT */
#include "shared/compiler.cl"
#include "shared/layout.h"
#include "shared/precision.cl"
#include "shared/skips.h"
#include "packet/apex.cl"
#include "packet/approx.cl"
#include "packet/camera.cl"
#include "packet/faces.cl"
#include "packet/lanes.cl"
#include "packet/tree.cl"
#include "packet/window.cl"
#include "packet/world.cl"
#include "tile/frustum.cl"

/* The part of a face that a window shows. */
typedef struct Patch {
    int face;
    const Camera *camera; /* sees it */
    Frustum corners;      /* from the camera to its corners */
    real error;           /* no point is farther from where it is said to be */
} Patch;

/* height, off: as approx_point takes them. */
INLINE Patch patch_of(const World *world, int face, const Camera *camera, const Frustum *c, real height, real off)
{
    global const wide *plane = world->planes + (size_t)face * PLANE_REALS;
    real4 x = vload4(0, c->x), y = vload4(0, c->y), z = vload4(0, c->z);
    real4 per_approach = 1 / fma(x, (real4)(real)plane[0], fma(y, (real4)(real)plane[1], z * (real)plane[2]));
    real4 t = height * per_approach;
    Patch patch;
    patch.face = face;
    patch.camera = camera;
    vstore4(t * x, 0, patch.corners.x);
    vstore4(t * y, 0, patch.corners.y);
    vstore4(t * z, 0, patch.corners.z);
    patch.error = APPROX_ERROR(most_of(t), longest_of(c), most_of(fabs(per_approach)), off);
    return patch;
}

typedef enum ShadowClass { LIT, PARTLY_SHADOWED, SHADOWED } ShadowClass;

/* The rays from a light to the corners of a patch. */
typedef struct LightFrustum {
    Apex apex;
    Frustum corners;
    real spread;     /* no ray ends farther from where it says */
    real slack;      /* so many times a face's error bounds cover the patch's error, too */
    bool cull_boxes; /* as setup_face */
} LightFrustum;

INLINE LightFrustum frustum_from_light(const Patch *patch, const wide *light, bool cull_boxes)
{
    const wide *eye = patch->camera->eye;
    real x = (real)(light[0] - eye[0]), y = (real)(light[1] - eye[1]), z = (real)(light[2] - eye[2]);
    LightFrustum f;
    for (int k = 0; k < 4; k++) {
        f.corners.x[k] = patch->corners.x[k] - x;
        f.corners.y[k] = patch->corners.y[k] - y;
        f.corners.z[k] = patch->corners.z[k] - z;
    }
    f.spread = patch->error + 2 * REAL_ROUNDING * GREATER(fabs(x), GREATER(fabs(y), fabs(z)));
    f.apex = apex_at(light, 0, longest_of(&f.corners) * (1 + 4 * REAL_ROUNDING));
    f.slack = SLACK_OF(f.spread / f.apex.length);
    f.cull_boxes = cull_boxes;
    return f;
}

/* The shadow that face i throws. backs: counts the faces that are left out as sides of closed boxes. */
INLINE ShadowClass shadow_of_face(const World *world, const LightFrustum *f, int i, uint *backs)
{
    FaceSetup face;
    Visibility visibility = setup_face(&f->apex, face_row(world, i), true, f->cull_boxes, &face);
    if (visibility == CULLED) {
        *backs += face.closed;
        return LIT;
    }
    if (visibility == UNCERTAIN)
        return PARTLY_SHADOWED;
    Coverage coverage = classify_face(&face, &f->corners, f->slack * face.edge_error, f->slack * face.edge_error);
    if (coverage == OUTSIDE)
        return LIT;
    real4 depths = frustum_depths(&face, &f->corners);
    real error = f->slack * face.depth_error;
    if (most_of(depths) + error < 1)
        return LIT; /* it lies beyond the points */
    bool all = coverage == COVERS && least_of(depths) - error > 1;
    return all ? SHADOWED : PARTLY_SHADOWED;
}

/* Classifies a patch for so many rays. PARTLY_SHADOWED: what may block the light is left on the stack. */
COMPILED_ONCE ShadowClass classify_shadow(const World *world, const Patch *patch, const wide *light, bool cull_boxes,
                                          uint rays, Stack *stack)
{
    LightFrustum f = frustum_from_light(patch, light, cull_boxes);
    RayBounds b = bounds_of_frustum(&f.apex, &f.corners, f.spread);
    bounds_shorten(&b, 1 + 4 * REAL_ROUNDING);
    if (cull_boxes)
        bounds_cull_sides(&b, true);
    *stack = stack_of(world, &b);
    uint tested = 0, backs = 0;
    ShadowClass shadow = LIT;
    for (int first, count; shadow == LIT && next_leaf(world, &b, rays, stack, &first, &count);) {
        uint backs_here = 0;
        if (tested + (uint)count > FRUSTUM_BUDGET)
            shadow = PARTLY_SHADOWED;
        for (int k = first; k < first + count && shadow == LIT; k++) {
            int i = face_in_leaf(world, k);
            if (i == patch->face)
                continue;
            tested++;
            shadow = shadow_of_face(world, &f, i, &backs_here);
        }
        if (shadow == PARTLY_SHADOWED)
            push_back(stack);
        else
            backs += backs_here;
    }
    if (shadow == PARTLY_SHADOWED)
        forget_distances(stack); /* they were shares of the rays' lengths */
    world->counters[COUNT_FACE_TESTS] += 4 * tested;
    world->counters[COUNT_SKIPPED + SKIP_BACK_FACE] += rays * backs;
    return shadow;
}
