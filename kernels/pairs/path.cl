/* A path in pairs of floats: steps 3 to 9, in the order of plain.cl. Colours and what is multiplied into them are
 * floats. */
#include "shared/layout.h"
#include "shared/precision.cl"
#include "plain/scene.cl"
#include "pairs/face.cl"
#include "pairs/pair.cl"
#include "pairs/search.cl"
#include "pairs/signs.cl"
#include "pairs/vector.cl"

/* Step 6. A light behind the face, or in its plane, leaves it in shadow. */
static bool light_reaches(Scene *scene, const PairHit *hit, const PairVec *light)
{
    int side = plane_side(scene, hit->face, light);
    if (hit->from_behind ? side >= 0 : side <= 0) {
        scene->counts[COUNT_SKIPPED + SKIP_LIGHT_BEHIND]++;
        return false;
    }
    return !is_blocked(scene, &hit->shifted, light, hit->face);
}

/* Step 7: Blinn-Phong with a quarter of the shininess. Unit vectors: n the normal, l to the light, v to the viewer. */
static float3 illuminate(global const real *material, global const real *light, float3 n, float3 l, float3 v,
                         bool reaches)
{
    float3 ambient = vload3(0, material + MATERIAL_AMBIENT) * vload3(0, light + LIGHT_AMBIENT);
    float3 diffuse = vload3(0, material + MATERIAL_DIFFUSE) * vload3(0, light + LIGHT_DIFFUSE);
    float3 specular = vload3(0, material + MATERIAL_SPECULAR) * vload3(0, light + LIGHT_SPECULAR);
    float3 h = unit_or_zero(l + v);
    float l_dot_n = fmax(vec3_dot(l, n), 0.0f), n_dot_h = fmax(vec3_dot(n, h), 0.0f);
    if (!reaches)
        return ambient;
    return ambient + l_dot_n * diffuse + pow(n_dot_h, material[MATERIAL_EXPONENT]) * specular;
}

/* Steps 6 to 8: the light that the point sends to the viewer. *reaching counts the lights that reach it. */
static float3 shade(Scene *scene, const PairHit *hit, float3 v, int *reaching)
{
    float3 colour = (float3)0;
    *reaching = 0;
    for (int i = 0; i < scene->parameters->light_count; i++) {
        global const real *light = scene->lights + i * LIGHT_REALS;
        PairVec position = pairs_from(vload3(0, light + LIGHT_POSITION), vload3(0, light + LIGHT_POSITION_LOW));
        bool reaches = light_reaches(scene, hit, &position);
        *reaching += reaches;
        if (!reaches && !scene->parameters->shadow_ambient)
            continue; /* step 8: black */
        float3 l = unit_or_zero(rounded(pairs_difference(position, hit->point)));
        colour += illuminate(face_material(scene, hit->face), light, rounded(hit->normal), l, v, reaches);
    }
    return colour;
}

/* Step 9. Its direction is as long as before. */
static PairRay mirrored_ray(const PairRay *ray, const PairHit *hit)
{
    Pair along = pairs_dot(ray->direction, hit->normal);
    PairVec turn = pairs_times(pair_ldexp(along, 1), hit->normal);
    PairRay mirrored = {hit->shifted, pairs_difference(ray->direction, turn), hit->face};
    return mirrored;
}

/* Steps 3 to 9: the sum of the hits' illuminations, each weighted by the mirrors before it. */
static float3 trace_path(Scene *scene, PairRay ray)
{
    constant const Parameters *p = scene->parameters;
    PairVec eye = ray.origin;
    float3 total = (float3)0;
    float weight = 1;
    for (int bounces = 0;; bounces++) {
        PairHit hit = nearest_hit(scene, &ray);
        if (hit.face < 0)
            return total + weight * vload3(0, scene->view + VIEW_BACKGROUND);
        place_hit(scene, &ray, &hit);
        float3 back = unit_or_zero(-rounded(ray.direction));
        float3 v = p->viewer_ray ? back : unit_or_zero(rounded(pairs_difference(eye, hit.point)));
        int reaching;
        total += weight * shade(scene, &hit, v, &reaching);
        float reflection = face_material(scene, hit.face)[MATERIAL_REFLECTION];
        if ((reaching == 0 && !p->shadow_ambient) || reflection == 0 || bounces == p->max_bounces)
            return total;
        ray = mirrored_ray(&ray, &hit);
        weight *= reflection;
        scene->counts[COUNT_REFLECTION]++;
    }
}
