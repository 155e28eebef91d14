/* Slips of step 7: the terms of the illumination. */
#include "grade/slip.h"

#include <stddef.h>

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
    double l_dot_n = vec3_dot(shine->hit->normal, shine->l);
    Illumination terms = with_diffuse(shine, l_dot_n);
    terms.l_dot_n = l_dot_n;
    return terms;
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
    double n_dot_h = vec3_dot(shine->hit->normal, slip_steps_terms(shine).h);
    Illumination terms = with_highlight(shine, pow(n_dot_h, exponent(shine)));
    terms.n_dot_h = n_dot_h;
    return terms;
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

static Illumination l_dot_h(const SlipShine *shine)
{
    double cosine = fmax(0, vec3_dot(shine->l, slip_steps_terms(shine).h));
    Illumination terms = with_highlight(shine, pow(cosine, exponent(shine)));
    terms.n_dot_h = cosine;
    return terms;
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

#define LIGHT "algorithm.md#7-illumination"
#define BLINN "s = (N.H)^(alpha/4)"
#define SUM "I = ka ia + kd id (L.N) + ks is s"

const Slip slip_term[] = {
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
    {"l-dot-h", "The highlight has L.H where N.H should be.", BLINN, "s = (L.H)^(alpha/4)", LIGHT,
     .steps = {.terms = l_dot_h}},
    {"no-cosine", "The diffuse term has no cosine.", "kd id (L.N)", "kd id", LIGHT,
     .steps = {.terms = diffuse_everywhere}},
    {"diffuse-not-clamped", "A light behind the face takes diffuse light away: L.N is not clamped at 0.", "max(0, L.N)",
     "L.N, and no test of the light's side", LIGHT, .steps = {.terms = diffuse_unclamped, .side = any_side}},
    {"diffuse-both-sides", "A light behind the face lights it, too: L.N is taken without its sign.", "max(0, L.N)",
     "|L.N|, and no test of the light's side", LIGHT, .steps = {.terms = diffuse_both_sides, .side = any_side}},
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
    {0},
};
