/* A face that a window of the screen sees everywhere, shaded packet by packet, in registers: what is the same for all its pixels
 * is worked out once. docs/algorithm.md, section 11. */
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
#include "tile/classify.cl"
#include "tile/frustum.cl"

#if CLASSIFIES_TILES

/* A light that counts on a facet. */
typedef struct FacetLight {
    real at[3];          /* told from the apex of the rays that see the facet */
    LightTerms terms;
    bool reaches;        /* at least some lanes */
    const Mask *blocked; /* packet by packet the lanes that it does not reach; NULL: none */
} FacetLight;

/* More lights than it has room for come in turns. */
typedef struct Facet {
    int face; /* -1: it is the background */
    Camera camera;
    real normal[3], sign, height, off; /* as sketch; the normal times sign is on the rays' side */
    real eye[3];                       /* told from the apex */
    bool along_ray;                    /* the viewer is where the ray comes from */
    global const real *material;
    real reflection;
    uint asked, behind, ambient_only, dull; /* so many lights are asked for; are behind it; do not matter; make no highlight */
    int light_count;
    FacetLight lights[CLASSIFIED_LIGHTS];
} Facet;

/* camera: its image after so many bounces. The lights are still to be added. */
INLINE void facet_of(const World *world, const CoveringFace *w, const Camera *camera, int bounces, Facet *f)
{
    f->face = w->face;
    if (w->face < 0)
        return;
    global const wide *plane = world->planes + (size_t)w->face * PLANE_REALS;
    f->camera = *camera;
    for (int axis = 0; axis < 3; axis++) {
        f->normal[axis] = (real)plane[axis];
        f->eye[axis] = (real)(view_value(world, VIEW_EYE + axis) - camera->eye[axis]);
    }
    f->sign = w->with_normal ? -1 : 1;
    f->height = approx_height(world, w->face, camera->eye);
    f->off = patch_off(world, w->face, camera);
    f->along_ray = world->parameters->viewer_ray || bounces == 0;
    f->material = world->materials + (size_t)face_material(world, w->face) * MATERIAL_REALS;
    f->reflection = f->material[MATERIAL_REFLECTION];
    f->asked = f->behind = f->ambient_only = f->dull = 0;
    f->light_count = 0;
}

/* Is a light to be asked for shadows on a face that is turned to it, or not? */
INLINE bool asks_light(const World *world, global const real *light, bool facing)
{
    return wants_light(world, light) && (facing || !MAY_SKIP(world->parameters, SKIP_LIGHT_BEHIND));
}

/* shade: how much of the facet lies in the light's shadow. blocked: where that is PARTLY_SHADOWED. */
INLINE void facet_add_light(const World *world, global const real *light, bool facing, ShadowClass shade,
                            const Mask *blocked, Facet *f)
{
    f->behind += !facing && MAY_SKIP(world->parameters, SKIP_LIGHT_BEHIND);
    f->ambient_only += facing && !wants_light(world, light);
    f->asked += asks_light(world, light, facing);
    if (!facing)
        shade = SHADOWED;
    if (shade == SHADOWED && !world->parameters->shadow_ambient)
        return;
    FacetLight *l = f->lights + f->light_count++;
    wide position[3];
    light_position(light, position);
    for (int axis = 0; axis < 3; axis++)
        l->at[axis] = (real)(position[axis] - f->camera.eye[axis]);
    l->terms = light_terms(world, f->material, light);
    l->reaches = shade != SHADOWED;
    l->blocked = shade == PARTLY_SHADOWED ? blocked : 0;
    f->dull += shade == LIT && !l->terms.has_highlight;
}

/* Rays of a tile came to the facet. */
INLINE void count_facet(const World *world, const Facet *f, uint rays)
{
    world->counters[COUNT_SKIPPED + SKIP_WHOLE_TILE] += rays;
    if (f->face < 0)
        return;
    world->counters[COUNT_SHADOW] += rays * f->asked;
    world->counters[COUNT_SKIPPED + SKIP_LIGHT_BEHIND] += rays * f->behind;
    world->counters[COUNT_SKIPPED + SKIP_LIGHT_AMBIENT] += rays * f->ambient_only;
    world->counters[COUNT_SKIPPED + SKIP_HIGHLIGHT] += rays * f->dull;
}

INLINE Vec vec_of(const real *v) { return vec((Lanes)v[0], (Lanes)v[1], (Lanes)v[2]); }

/* Where packet p's rays meet the facet. */
INLINE ApproxPoint approx_on_facet(const Facet *f, const ScreenPlaces *places, int p, Vec *ahead)
{
    *ahead = vec_to_real(camera_direction(&f->camera, places, p));
    return approx_point(*ahead, (Lanes)f->height, (Lanes)f->off, vec_of(f->normal));
}

/* Adds the light that packet p's part of the facet sends, as `shade` has it, to `colour`, and the lanes that some light reaches to
 * `lit`. False: a sketch is too rough. */
INLINE bool shade_facet(const World *world, const Facet *f, const ScreenPlaces *places, int p, Mask active,
                        Vec *colour, Mask *lit)
{
    Vec ahead, l;
    ApproxPoint approx = approx_on_facet(f, places, p, &ahead);
    Vec normal = vec_scale((Lanes)f->sign, vec_of(f->normal)), v = vec_scale(-1 / approx.length, ahead);
    Lanes per_length, share;
    if (!f->along_ray && !approx_towards(&approx, vec_of(f->eye), active, &v, &per_length, &share))
        return false;
    for (int i = 0; i < f->light_count; i++) {
        const FacetLight *light = f->lights + i;
        Vec in_shadow = shine_in_shadow(&light->terms), sum = in_shadow;
        Mask reaches = light->blocked ? active & ~light->blocked[p] : active;
        if (light->reaches) {
            if (!approx_towards(&approx, vec_of(light->at), active, &l, &per_length, &share))
                return false;
            sum = shine(&light->terms, l, v, normal);
            *lit |= reaches;
        }
        if (light->blocked)
            sum = vec_select(reaches, sum, world->parameters->shadow_ambient ? in_shadow : vec(0, 0, 0));
        *colour = vec_add(*colour, sum);
    }
    return true;
}

#endif
