/* What the corners of a window, a block of tiles or one tile, tell of all its pixels: the face that they see, what it mirrors, and
 * of each light whether it reaches them, or whether nothing of it does. docs/algorithm.md, section 11. */
#include "shared/compiler.cl"
#include "shared/layout.h"
#include "shared/precision.cl"
#include "shared/skips.h"
#include "packet/apex.cl"
#include "packet/approx.cl"
#include "packet/camera.cl"
#include "packet/faces.cl"
#include "packet/lanes.cl"
#include "packet/light.cl"
#include "packet/nearest.cl"
#include "packet/planes.cl"
#include "packet/tree.cl"
#include "packet/world.cl"
#include "tile/frustum.cl"

#define CLASSIFIES_TILES (HAS_APPROX && PACKETS > 1)

#if !CLASSIFIES_TILES

typedef int Classification;

INLINE bool has_first_hit(const Classification *o) { return false; }

INLINE bool classify_window(const World *world, const Window *window, uint rays, const Classification *parent,
                            Classification *o)
{
    return false;
}

#else

/* The part of a face that a window shows. */
typedef struct Patch {
    Frustum corners; /* from the apex */
    real error;         /* of the corners, and of any point between them */
} Patch;

/* height, off: as sketch. */
INLINE Patch patch_on(const World *world, int face, const Frustum *c, real height, real off)
{
    global const wide *plane = world->planes + (size_t)face * PLANE_REALS;
    real4 x = vload4(0, c->x), y = vload4(0, c->y), z = vload4(0, c->z);
    real4 per_approach = 1 / fma(x, (real4)(real)plane[0], fma(y, (real4)(real)plane[1], z * (real)plane[2]));
    real4 t = height * per_approach;
    Patch patch;
    vstore4(t * x, 0, patch.corners.x);
    vstore4(t * y, 0, patch.corners.y);
    vstore4(t * z, 0, patch.corners.z);
    patch.error = APPROX_ERROR(most_of(t), longest_of(c), most_of(fabs(per_approach)), off);
    return patch;
}

/* How far a face's height may be off. */
INLINE real patch_off(const World *world, int face, const Camera *camera)
{
    wide apart = fabs(camera->eye[0]) + fabs(camera->eye[1]) + fabs(camera->eye[2]);
    return APPROX_OFF((real)apart + vertex_magnitudes(world, face));
}

/* How much of it lies in the shadow of a light. outside, lanes, stack: as classify_shadow. */
INLINE ShadowClass classify_shadow_on(const World *world, int face, const Patch *patch, const Camera *camera,
                                      const wide *light, bool cull_boxes, uint lanes, Stack *stack)
{
    Frustum c;
    real x = (real)(light[0] - camera->eye[0]), y = (real)(light[1] - camera->eye[1]), z = (real)(light[2] - camera->eye[2]);
    for (int k = 0; k < 4; k++) {
        c.x[k] = patch->corners.x[k] - x;
        c.y[k] = patch->corners.y[k] - y;
        c.z[k] = patch->corners.z[k] - z;
    }
    real spread = patch->error + 2 * REAL_ROUNDING * GREATER(fabs(x), GREATER(fabs(y), fabs(z)));
    Apex a = apex_at(light, 0, longest_of(&c) * (1 + 4 * REAL_ROUNDING));
    return classify_shadow(world, &a, &c, spread, face, cull_boxes, lanes, stack);
}

/* The apex of rays between corners after so many bounces. */
INLINE Apex apex_of_image(const World *world, const Camera *camera, const Frustum *corners, int bounces)
{
    real far = (real)(fabs(camera->eye[0]) + fabs(camera->eye[1]) + fabs(camera->eye[2])) + world->view[VIEW_FARTHEST];
    real spread = (real)bounces * ((real)(256 * WIDE_ROUNDING) * far + 4 * SHIFT_FLOOR);
    return apex_at(camera->eye, spread, GREATER(world->view[VIEW_LENGTH], longest_of(corners)) * (1 + 8 * REAL_ROUNDING));
}

INLINE Traversal begin_in_frustum(const World *world, const Apex *a, const Frustum *corners)
{
    RayBounds all = bounds_of_frustum(a, corners, 0);
    return begin_traversal(world, &all);
}

enum { CLASSIFIED_BOUNCES = 16, CLASSIFIED_LIGHTS = 32 };

/* What the corners of a window tell of all its pixels, bounce by bounce. */
typedef struct Classification {
    int bounces; /* so many are told; of the next one `rest` is left to be searched */
    CoveringFace faces[CLASSIFIED_BOUNCES];
    uint facing[CLASSIFIED_BOUNCES]; /* bit i: the face is turned to light i, of the first CLASSIFIED_LIGHTS */
    uint clear[CLASSIFIED_BOUNCES];  /* nothing is between */
    uint dark[CLASSIFIED_BOUNCES];   /* something is, everywhere */
    Traversal rest;
} Classification;

/* Is it known what is seen first? */
INLINE bool has_first_hit(const Classification *o) { return o->bounces > 0; }

/* Is the side of the face that is seen turned to the light? As turned_to_light. */
INLINE bool faces_the_light(const World *world, const CoveringFace *w, const wide *light)
{
    wide side = plane_distance_of_point(world, w->face, light);
    return w->with_normal ? side < 0 : side > 0;
}

/* Its lights, after so many bounces, but for those that are told. */
INLINE void classify_lights(const World *world, const Camera *camera, const Frustum *corners, int bounce, uint rays,
                            Classification *o)
{
    const CoveringFace *w = o->faces + bounce;
    Patch patch = patch_on(world, w->face, corners, approx_height(world, w->face, camera->eye), patch_off(world, w->face, camera));
    for (int i = 0; i < min((int)CLASSIFIED_LIGHTS, world->parameters->light_count); i++) {
        global const real *light = world->lights + i * LIGHT_REALS;
        wide position[3];
        light_position(light, position);
        if ((o->clear[bounce] | o->dark[bounce]) >> i & 1 || !faces_the_light(world, w, position))
            continue;
        o->facing[bounce] |= 1u << i;
        if (!wants_light(world, light))
            continue;
        Stack stack;
        uint backs = world->counters[COUNT_SKIPPED + SKIP_BACK_FACE];
        ShadowClass shade = classify_shadow_on(world, w->face, &patch, camera, position, bounce == 0, rays, &stack);
        o->clear[bounce] |= shade == LIT ? 1u << i : 0;
        o->dark[bounce] |= shade == SHADOWED ? 1u << i : 0;
        if (shade == PARTLY_SHADOWED)
            world->counters[COUNT_SKIPPED + SKIP_BACK_FACE] = backs; /* parts of the window ask them again */
    }
}

/* Fills the outlook of a window of so many rays. parent: of a window around it, from which it goes on, or NULL. Returns whether it
 * goes to the end, but for the lights. */
NOINLINE bool classify_window(const World *world, const Window *window, uint rays, const Classification *parent,
                              Classification *o)
{
    Camera camera = camera_of(world);
    int from = -1, told = parent ? parent->bounces : 0;
    for (int bounce = 0;; bounce++) {
        Frustum corners = camera_frustum(&camera, window);
        CoveringFace *w = o->faces + bounce;
        if (bounce < told) {
            *w = parent->faces[bounce];
            o->facing[bounce] = parent->facing[bounce];
            o->clear[bounce] = parent->clear[bounce];
            o->dark[bounce] = parent->dark[bounce];
        } else {
            Apex a = apex_of_image(world, &camera, &corners, bounce);
            o->bounces = bounce;
            o->rest = parent && bounce == told ? parent->rest : begin_in_frustum(world, &a, &corners);
            if (bounce == CLASSIFIED_BOUNCES || !MAY_SKIP(world->parameters, SKIP_WHOLE_TILE) ||
                !find_covering_face(world, &a, &corners, from, rays, w, &o->rest))
                return false;
            o->facing[bounce] = o->clear[bounce] = o->dark[bounce] = 0;
        }
        o->bounces = bounce + 1;
        from = w->face;
        if (from < 0)
            return true;
        classify_lights(world, &camera, &corners, bounce, rays, o);
        real reflection = world->materials[(size_t)face_material(world, from) * MATERIAL_REALS + MATERIAL_REFLECTION];
        if (reflection == 0 || bounce == world->parameters->max_bounces)
            return true;
        camera = camera_in_mirror(world, from, &camera);
    }
}

#endif
