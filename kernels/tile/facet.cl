/* Facets. A facet is a face that all rays of a window hit, with all that is the same for these rays: the image of the
 * camera in the mirrors before it, the plane, the material, and the lights with their colours.
 *
 *     for each packet: for each light that counts on the facet
 *         colour += the ambient term, and where the light reaches the other two, as packet/light.cl has them
 *
 * It buys that nothing is fetched or blended lane by lane, and that the packet stays in registers. */
#include "shared/compiler.cl"
#include "shared/layout.h"
#include "shared/precision.cl"
#include "shared/skips.h"
#include "packet/approx.cl"
#include "packet/camera.cl"
#include "packet/faces.cl"
#include "packet/lanes.cl"
#include "packet/light.cl"
#include "packet/vectors.cl"
#include "packet/world.cl"
#include "tile/covering_face.cl"
#include "tile/shadow_class.cl"

/* A light that counts on a facet. */
typedef struct FacetLight {
    real at[3]; /* from the apex of the rays that hit the facet */
    LightTerms terms;
    bool reaches;        /* at least some lanes */
    const Mask *blocked; /* packet by packet the lanes that it does not reach; NULL: none */
} FacetLight;

/* A facet has room for so many lights. More of them come in turns. */
enum { FACET_LIGHTS = 32 };

typedef struct Facet {
    int face; /* -1: it is the background */
    bool last; /* no ray goes on from here */
    Camera camera;
    real normal[3], sign;  /* the normal times sign is on the rays' side */
    real height, off;      /* as approx_point takes them */
    real eye[3];           /* from the apex */
    bool along_ray;        /* the viewer is where the ray comes from */
    global const real *material;
    real reflection;
    uint want_shadow, behind, ambient_only; /* so many lights want shadow rays; are behind it; do not matter */
    uint dull;      /* so many lights reach all rays, and make no highlight */
    uint dull_rays; /* lights that reach only some rays and make no highlight: their rays' number, added up */
    int next_light, light_count;
    FacetLight lights[FACET_LIGHTS];
} Facet;

/* camera: its image after so many bounces. The lights are still to be added. */
COMPILED_ONCE void make_facet(const World *world, CoveringFace seen, const Camera *camera, int bounces, Facet *f)
{
    f->face = seen.face;
    f->last = true;
    f->want_shadow = f->behind = f->ambient_only = f->dull = f->dull_rays = 0;
    f->next_light = f->light_count = 0;
    if (seen.face < 0)
        return;
    global const wide *plane = world->planes + (size_t)seen.face * PLANE_REALS;
    f->camera = *camera;
    for (int axis = 0; axis < 3; axis++) {
        f->normal[axis] = (real)plane[axis];
        f->eye[axis] = (real)(view_value(world, VIEW_EYE + axis) - camera->eye[axis]);
    }
    f->sign = seen.from_behind ? -1 : 1;
    f->height = approx_height(world, seen.face, camera->eye);
    f->off = APPROX_OFF((real)magnitudes_of(camera->eye) + vertex_magnitudes(world, seen.face));
    f->along_ray = world->parameters->viewer_ray || bounces == 0;
    f->material = world->materials + (size_t)face_material(world, seen.face) * MATERIAL_REALS;
    f->reflection = f->material[MATERIAL_REFLECTION];
    f->last = f->reflection == 0 || bounces == world->parameters->max_bounces;
}

/* Does a light want shadow rays from a face that is turned to it, or is not? */
INLINE bool wants_shadow_rays(const World *world, global const real *light, bool facing)
{
    return wants_light(world, light) && (facing || !MAY_SKIP(world->parameters, SKIP_LIGHT_BEHIND));
}

/* shadow: how much of the facet lies in the light's shadow. blocked: where, if it is PARTLY_SHADOWED. */
INLINE void add_light(const World *world, global const real *light, bool facing, ShadowClass shadow,
                      const Mask *blocked, Facet *f)
{
    f->behind += !facing && MAY_SKIP(world->parameters, SKIP_LIGHT_BEHIND);
    f->ambient_only += facing && !wants_light(world, light);
    f->want_shadow += wants_shadow_rays(world, light, facing);
    if (!facing)
        shadow = SHADOWED;
    if (shadow == SHADOWED && !world->parameters->shadow_ambient)
        return;
    FacetLight *l = f->lights + f->light_count++;
    wide position[3];
    light_position(light, position);
    for (int axis = 0; axis < 3; axis++)
        l->at[axis] = (real)(position[axis] - f->camera.eye[axis]);
    l->terms = light_terms(world, f->material, light);
    l->reaches = shadow != SHADOWED;
    l->blocked = shadow == PARTLY_SHADOWED ? blocked : 0;
    f->dull += shadow == LIT && !l->terms.has_highlight;
}

/* Counts what so many rays do at the facet. */
INLINE void count_facet(const World *world, const Facet *f, uint rays)
{
    world->counters[COUNT_SKIPPED + SKIP_WHOLE_TILE] += rays;
    world->counters[COUNT_SHADOW] += rays * f->want_shadow;
    world->counters[COUNT_SKIPPED + SKIP_LIGHT_BEHIND] += rays * f->behind;
    world->counters[COUNT_SKIPPED + SKIP_LIGHT_AMBIENT] += rays * f->ambient_only;
    world->counters[COUNT_SKIPPED + SKIP_HIGHLIGHT] += rays * f->dull + f->dull_rays;
}

INLINE Vec vec_of(const real *v) { return vec((Lanes)v[0], (Lanes)v[1], (Lanes)v[2]); }

/* Where packet p's rays meet the facet. */
INLINE ApproxPoint approx_on_facet(const Facet *f, const ScreenPlaces *places, int p, Vec *ahead)
{
    *ahead = vec_to_real(camera_direction(&f->camera, places, p));
    return approx_point(*ahead, (Lanes)f->height, (Lanes)f->off, vec_of(f->normal));
}

/* Adds to `sum` what the active lanes of packet p see of the facet. False: an approximate point is too far off. */
INLINE bool shade_facet(const World *world, const Facet *f, const ScreenPlaces *places, int p, Mask active,
                        Illumination *sum)
{
    Vec ahead, l;
    ApproxPoint approx = approx_on_facet(f, places, p, &ahead);
    Vec normal = vec_scale((Lanes)f->sign, vec_of(f->normal)), v = vec_scale(-1 / approx.length, ahead);
    Lanes per_length, share;
    if (!f->along_ray && !approx_towards(&approx, vec_of(f->eye), active, &v, &per_length, &share))
        return false;
    for (int i = 0; i < f->light_count; i++) {
        const FacetLight *light = f->lights + i;
        Vec in_shadow = shine_in_shadow(&light->terms), colour = in_shadow;
        Mask reaches = light->blocked ? active & ~light->blocked[p] : active;
        if (light->reaches) {
            if (!approx_towards(&approx, vec_of(light->at), active, &l, &per_length, &share))
                return false;
            colour = shine(&light->terms, l, v, normal);
            sum->lit |= reaches;
        }
        if (light->blocked)
            colour = vec_select(reaches, colour, world->parameters->shadow_ambient ? in_shadow : vec(0, 0, 0));
        sum->colour = vec_add(sum->colour, colour);
    }
    return true;
}
