/* Slips of steps 7 and 8: the illumination. */
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

/* --- The terms --- */

/* The right terms with another diffuse factor. */
static Illumination with_diffuse(const SlipShine *shine, double factor)
{
    Illumination terms = slip_steps_terms(shine);
    terms.diffuse = vec3_scale(factor, vec3_multiply(shine->material.diffuse, shine->light.diffuse));
    return terms;
}

/* The right terms with another highlight. */
static Illumination with_highlight(const SlipShine *shine, double highlight)
{
    Illumination terms = slip_steps_terms(shine);
    terms.specular = vec3_scale(highlight, vec3_multiply(shine->material.specular, shine->light.specular));
    return terms;
}

static double exponent(const SlipShine *shine)
{
    return shine->material.shininess / 4;
}

static Illumination diffuse_everywhere(const SlipShine *shine)
{
    return with_diffuse(shine, 1);
}

static Illumination diffuse_unclamped(const SlipShine *shine)
{
    return with_diffuse(shine, vec3_dot(shine->hit->normal, shine->l));
}

/* The shadow ray alone decides. */
static int any_side(const Scene *scene, const SlipHit *hit, int light)
{
    (void)scene;
    (void)hit;
    (void)light;
    return 1;
}

static Illumination diffuse_both_sides(const SlipShine *shine)
{
    return with_diffuse(shine, fabs(vec3_dot(shine->hit->normal, shine->l)));
}

static Illumination diffuse_negated(const SlipShine *shine)
{
    return with_diffuse(shine, fmax(0, -vec3_dot(shine->hit->normal, shine->l)));
}

static Illumination diffuse_of_viewer(const SlipShine *shine)
{
    return with_diffuse(shine, fmax(0, vec3_dot(shine->hit->normal, shine->v)));
}

static Illumination highlight_unclamped(const SlipShine *shine)
{
    Illumination terms = slip_steps_terms(shine);
    return with_highlight(shine, pow(vec3_dot(shine->hit->normal, terms.h), exponent(shine)));
}

static Illumination highlight_both_sides(const SlipShine *shine)
{
    Illumination terms = slip_steps_terms(shine);
    return with_highlight(shine, pow(fabs(vec3_dot(shine->hit->normal, terms.h)), exponent(shine)));
}

/* Phong's (R.V): R is L mirrored at N. */
static double r_dot_v(const SlipShine *shine)
{
    Vec3 n = shine->hit->normal, r = vec3_sub(vec3_scale(2 * vec3_dot(n, shine->l), n), shine->l);
    return fmax(0, vec3_dot(r, shine->v));
}

static Illumination phong(const SlipShine *shine)
{
    return with_highlight(shine, pow(r_dot_v(shine), exponent(shine)));
}

static Illumination phong_undivided(const SlipShine *shine)
{
    return with_highlight(shine, pow(r_dot_v(shine), shine->material.shininess));
}

static Illumination with_h(const SlipShine *shine, Vec3 h)
{
    double n_dot_h = fmax(0, vec3_dot(shine->hit->normal, h));
    Illumination terms = with_highlight(shine, pow(n_dot_h, exponent(shine)));
    terms.h = h;
    terms.n_dot_h = n_dot_h;
    return terms;
}

static Illumination h_not_unit(const SlipShine *shine)
{
    return with_h(shine, vec3_add(shine->l, shine->v));
}

static Illumination h_halved(const SlipShine *shine)
{
    return with_h(shine, vec3_scale(0.5, vec3_add(shine->l, shine->v)));
}

static Illumination h_difference(const SlipShine *shine)
{
    return with_h(shine, vec3_unit(vec3_sub(shine->l, shine->v)));
}

static Illumination h_is_l(const SlipShine *shine)
{
    return with_h(shine, shine->l);
}

static Illumination highlight_times_cosine(const SlipShine *shine)
{
    Illumination terms = slip_steps_terms(shine);
    terms.specular = vec3_scale(terms.l_dot_n, terms.specular);
    return terms;
}

/* Fading with the distance: the text has lights that do not fade. */
static Illumination fading(const SlipShine *shine)
{
    Vec3 way = vec3_sub(shine->light.position, shine->hit->point);
    Illumination terms = slip_steps_terms(shine);
    double factor = 1 / vec3_dot(way, way);
    terms.diffuse = vec3_scale(factor, terms.diffuse);
    terms.specular = vec3_scale(factor, terms.specular);
    return terms;
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

static Vec3 only_the_last(Vec3 sum, Vec3 light)
{
    (void)sum;
    return light;
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
    {"phong", "The highlight is Phong's, of the mirrored light, not Blinn's.", BLINN, "s = (R.V)^(alpha/4)", LIGHT,
     .steps = {.terms = phong}},
    {"phong-undivided", "The highlight is Phong's, with the exponent alpha.", BLINN, "s = (R.V)^alpha", LIGHT,
     .steps = {.terms = phong_undivided}},
    {"h-not-unit", "The halfway vector is not made a unit vector.", "H = unit(L + V)", "H = L + V", LIGHT,
     .steps = {.terms = h_not_unit}},
    {"h-halved", "The halfway vector is the mean of L and V, which is no unit vector.", "H = unit(L + V)",
     "H = (L + V)/2", LIGHT, .steps = {.terms = h_halved}},
    {"h-difference", "The halfway vector is made of the difference of L and V.", "H = unit(L + V)", "H = unit(L - V)",
     LIGHT, .steps = {.terms = h_difference}},
    {"h-is-l", "The highlight has L where H should be.", BLINN, "s = (N.L)^(alpha/4)", LIGHT,
     .steps = {.terms = h_is_l}},
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
    {"no-cosine", "The diffuse term has no cosine.", "kd id (L.N)", "kd id", LIGHT,
     .steps = {.terms = diffuse_everywhere}},
    {"diffuse-not-clamped", "A light behind the face takes diffuse light away: L.N is not clamped at 0.", "max(0, L.N)",
     "L.N, and no test of the light's side", LIGHT, .steps = {.terms = diffuse_unclamped, .side = any_side}},
    {"diffuse-both-sides", "The diffuse term has the absolute value of L.N.", "max(0, L.N)", "|L.N|", LIGHT,
     .steps = {.terms = diffuse_both_sides}},
    {"diffuse-negated", "L.N has the wrong sign.", "max(0, L.N)", "max(0, -L.N)", LIGHT,
     .steps = {.terms = diffuse_negated}},
    {"diffuse-of-viewer", "The diffuse term has V where L should be.", "kd id (L.N)", "kd id (V.N)", LIGHT,
     .steps = {.terms = diffuse_of_viewer}},
    {"highlight-not-clamped", "N.H is not clamped at 0 before it is raised to the power.", "s = max(0, N.H)^(alpha/4)",
     "s = (N.H)^(alpha/4) of a negative N.H", LIGHT, .steps = {.terms = highlight_unclamped}},
    {"highlight-both-sides", "The highlight has the absolute value of N.H.", "max(0, N.H)", "|N.H|", LIGHT,
     .steps = {.terms = highlight_both_sides}},
    {"highlight-cosine", "The highlight is multiplied by L.N.", "ks is s", "ks is s (L.N)", LIGHT,
     .steps = {.terms = highlight_times_cosine}},
    {"fading-light", "The light fades with the distance; in the text it does not.", SUM,
     "kd id (L.N) and ks is s over the distance squared", LIGHT, .steps = {.terms = fading}},
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
    {"ambient-once", "The ambient term counts once, not once for each light.", "the sum of I over the lights",
     "ka ia of one light only", SHADOW, .steps = {.lit = ambient_once}},
    {"last-light-only", "Only the last light counts: the lights are not added up.", "the sum of I over the lights",
     "I of the last light", SHADOW, .steps = {.add_light = only_the_last}},
    {"dark-goes-on", "The path goes on where no light reaches the point; by the rule \"black\" it ends.",
     "\"shadow\" black: the path ends in shadow", "the path goes on", SHADOW, .steps = {.ends = dark_goes_on}},
    {0},
};
