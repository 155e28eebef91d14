/* Slips of steps 7 and 8: colours and directions, and what is added up. */
#include "grade/slip.h"

#include <stddef.h>

/* --- The materials' and the lights' colours --- */

static const Vec3 white = {1, 1, 1}, black = {0, 0, 0};

static void light_colours_forgotten(Material *material, Light *light)
{
    (void)material;
    light->ambient = light->diffuse = light->specular = white;
}

static void one_light_colour(Material *material, Light *light)
{
    (void)material;
    light->ambient = light->specular = light->diffuse;
}

static void alpha_undivided(Material *material, Light *light)
{
    (void)light;
    material->shininess *= 4;
}

static void alpha_halved(Material *material, Light *light)
{
    (void)light;
    material->shininess *= 2;
}

static void no_exponent(Material *material, Light *light)
{
    (void)light;
    material->shininess = 4;
}

static void no_ambient(Material *material, Light *light)
{
    (void)light;
    material->ambient = black;
}

static void no_diffuse(Material *material, Light *light)
{
    (void)light;
    material->diffuse = black;
}

static void no_specular(Material *material, Light *light)
{
    (void)light;
    material->specular = black;
}

static void white_highlight(Material *material, Light *light)
{
    (void)light;
    material->specular = white;
}

static void full_diffuse(Material *material, Light *light)
{
    (void)material;
    light->diffuse = white;
}

static void full_specular(Material *material, Light *light)
{
    (void)material;
    light->specular = white;
}

static void full_ambient(Material *material, Light *light)
{
    (void)material;
    light->ambient = white;
}

/* --- The directions --- */

static Vec3 as_it_is(Vec3 way)
{
    return way;
}

static Vec3 backwards(Vec3 way)
{
    return vec3_negate(vec3_unit(way));
}

static Vec3 viewer_not_unit(const Scene *scene, const SlipHit *hit)
{
    return scene->shading.viewer == VIEWER_RAY ? vec3_negate(hit->ray.direction)
                                               : vec3_sub(scene->camera.position, hit->point);
}

static Vec3 viewer_backwards(const Scene *scene, const SlipHit *hit)
{
    return scene->shading.viewer == VIEWER_RAY ? hit->r : vec3_unit(vec3_sub(hit->point, scene->camera.position));
}

static void other_viewer_rule(Scene *scene)
{
    scene->shading.viewer = scene->shading.viewer == VIEWER_RAY ? VIEWER_CAMERA : VIEWER_RAY;
}

static void other_shadow_rule(Scene *scene)
{
    scene->shading.shadow = scene->shading.shadow == SHADOW_BLACK ? SHADOW_AMBIENT : SHADOW_BLACK;
}

/* --- What counts --- */

static Vec3 ambient_once(const SlipShine *shine, const Illumination *terms)
{
    Vec3 rest = vec3_add(terms->diffuse, terms->specular);
    Vec3 ambient = shine->index == 0 || (shine->scene->shading.shadow == SHADOW_BLACK && shine->reaching == 0)
                       ? terms->ambient
                       : black;
    return shine->reaches ? vec3_add(ambient, rest) : ambient;
}

static Vec3 all_terms_in_shadow(const SlipShine *shine, const Illumination *terms)
{
    (void)shine;
    return vec3_add(vec3_add(terms->ambient, terms->diffuse), terms->specular);
}

static Vec3 nothing_in_shadow(const SlipShine *shine, const Illumination *terms)
{
    return shine->reaches ? all_terms_in_shadow(shine, terms) : black;
}

static Vec3 only_the_last(Vec3 sum, Vec3 light)
{
    (void)sum;
    return light;
}

static bool dark_ends(const SlipEnd *end, PathEnd *reason)
{
    bool dark = end->reaching == 0, last = end->bounces == end->scene->shading.max_bounces;
    *reason = dark ? PATH_IN_SHADOW : end->material->reflection == 0 ? PATH_NOT_MIRROR : PATH_MAX_BOUNCES;
    return dark || end->material->reflection == 0 || last;
}

static bool dark_goes_on(const SlipEnd *end, PathEnd *reason)
{
    *reason = end->material->reflection == 0 ? PATH_NOT_MIRROR : PATH_MAX_BOUNCES;
    return end->material->reflection == 0 || end->bounces == end->scene->shading.max_bounces;
}

#define LIGHT "algorithm.md#7-illumination"
#define SHADOW "algorithm.md#8-points-in-shadow"
#define BLINN "s = (N.H)^(alpha/4)"
#define SUM "I = ka ia + kd id (L.N) + ks is s"

const Slip slip_shading[] = {
    {"alpha-undivided", "The exponent is alpha, not alpha/4.", BLINN, "s = (N.H)^alpha", LIGHT,
     .steps = {.colours = alpha_undivided}},
    {"alpha-halved", "The exponent is alpha/2, not alpha/4.", BLINN, "s = (N.H)^(alpha/2)", LIGHT,
     .steps = {.colours = alpha_halved}},
    {"no-exponent", "The highlight has no exponent.", BLINN, "s = N.H", LIGHT, .steps = {.colours = no_exponent}},
    {"light-colour-forgotten", "The light's colours are forgotten.", SUM, "I = ka + kd (L.N) + ks s", LIGHT,
     .steps = {.colours = light_colours_forgotten}},
    {"light-colour-diffuse", "The light's diffuse colour is used for all three terms.", SUM,
     "I = ka id + kd id (L.N) + ks id s", LIGHT, .steps = {.colours = one_light_colour}},
    {"light-ambient-forgotten", "The light's ambient colour is forgotten.", SUM, "I = ka + kd id (L.N) + ks is s",
     LIGHT, .steps = {.colours = full_ambient}},
    {"light-diffuse-forgotten", "The light's diffuse colour is forgotten.", SUM, "I = ka ia + kd (L.N) + ks is s",
     LIGHT, .steps = {.colours = full_diffuse}},
    {"light-specular-forgotten", "The light's specular colour is forgotten.", SUM, "I = ka ia + kd id (L.N) + ks s",
     LIGHT, .steps = {.colours = full_specular}},
    {"ambient-missing", "The ambient term is missing.", SUM, "I = kd id (L.N) + ks is s", LIGHT,
     .steps = {.colours = no_ambient}},
    {"diffuse-missing", "The diffuse term is missing.", SUM, "I = ka ia + ks is s", LIGHT,
     .steps = {.colours = no_diffuse}},
    {"specular-missing", "The specular term is missing.", SUM, "I = ka ia + kd id (L.N)", LIGHT,
     .steps = {.colours = no_specular}},
    {"ks-forgotten", "The material's specular colour is forgotten: every highlight is white.", SUM,
     "I = ka ia + kd id (L.N) + is s", LIGHT, .steps = {.colours = white_highlight}},
    {"l-not-unit", "L is not made a unit vector.", "L = unit(light - P)", "L = light - P", LIGHT,
     .steps = {.to_light = as_it_is}},
    {"l-backwards", "L points from the light to the point.", "L = unit(light - P)", "L = unit(P - light)", LIGHT,
     .steps = {.to_light = backwards}},
    {"v-not-unit", "V is not made a unit vector.", "V = unit(C - P)", "V = C - P", LIGHT,
     .steps = {.viewer = viewer_not_unit}},
    {"v-backwards", "V points from the viewer to the point.", "V = unit(C - P)", "V = unit(P - C)", LIGHT,
     .steps = {.viewer = viewer_backwards}},
    {"viewer-rule", "V follows the other rule: to the camera, or back along the ray.", "\"viewer\" as the scene says",
     "\"viewer\" the other way", LIGHT, .steps = {.scene = other_viewer_rule}},
    {"shadow-rule", "Points in shadow follow the other rule: black, or ambient.", "\"shadow\" as the scene says",
     "\"shadow\" the other way", SHADOW, .steps = {.scene = other_shadow_rule}},
    {"lit-in-shadow", "A light that is blocked counts with all its terms.", "in shadow I = ka ia", SUM, SHADOW,
     .steps = {.lit = all_terms_in_shadow}},
    {"nothing-in-shadow", "A light in shadow adds nothing, although the rule is \"ambient\".",
     "by the rule \"ambient\", I = ka ia in shadow", "I = 0 in shadow", SHADOW, .steps = {.lit = nothing_in_shadow}},
    {"dark-ends", "The path ends where no light reaches the point; by the rule \"ambient\" it goes on.",
     "\"shadow\" ambient: the path goes on", "the path ends in shadow", SHADOW, .steps = {.ends = dark_ends}},
    {"ambient-once", "The ambient term counts once, not once for each light.", "the sum of I over the lights",
     "ka ia of one light only", SHADOW, .steps = {.lit = ambient_once}},
    {"last-light-only", "Only the last light counts: the lights are not added up.", "the sum of I over the lights",
     "I of the last light", SHADOW, .steps = {.add_light = only_the_last}},
    {"dark-goes-on", "The path goes on where no light reaches the point; by the rule \"black\" it ends.",
     "\"shadow\" black: the path ends in shadow", "the path goes on", SHADOW, .steps = {.ends = dark_goes_on}},
    {0},
};
