/* Lights, and what a face shows in one of them (Blinn, "Models of Light Reflection for Computer Synthesized Pictures",
 * 1977):
 *
 *     I = ka ia + kd id (L.N) + ks is (N.H)^(alpha/4),   H = (L + V) / |L + V|
 *
 * Packets of rays and whole tiles are shaded by this one formula. plain.cl, which is to be read by itself, has its own.
 * docs/algorithm.md, section 7. */
#include "shared/compiler.cl"
#include "shared/layout.h"
#include "shared/precision.cl"
#include "shared/skips.h"
#include "packet/lanes.cl"
#include "packet/power.cl"
#include "packet/vectors.cl"
#include "packet/world.cl"

/* The terms of a material in a light, as far as they do not depend on the point. */
typedef struct LightTerms {
    real3 ambient, diffuse, specular; /* ka ia, kd id, ks is */
    real exponent;                    /* alpha/4 */
    bool has_highlight;               /* false: the specular term is black, and left out */
} LightTerms;

/* The product of two colours: a material's and a light's. */
INLINE real3 coloured(global const real *material, global const real *light)
{
    return (real3)(material[0] * light[0], material[1] * light[1], material[2] * light[2]);
}

INLINE LightTerms light_terms(const World *world, global const real *material, global const real *light)
{
    LightTerms terms;
    terms.ambient = coloured(material + MATERIAL_AMBIENT, light + LIGHT_AMBIENT);
    terms.diffuse = coloured(material + MATERIAL_DIFFUSE, light + LIGHT_DIFFUSE);
    terms.specular = coloured(material + MATERIAL_SPECULAR, light + LIGHT_SPECULAR);
    terms.exponent = material[MATERIAL_EXPONENT];
    bool black = terms.specular.x == 0 && terms.specular.y == 0 && terms.specular.z == 0;
    terms.has_highlight = !MAY_SKIP(world->parameters, SKIP_HIGHLIGHT) || !black;
    return terms;
}

/* What all lights add up to at the hits of a packet. */
typedef struct Illumination {
    Vec colour;
    Mask lit; /* the lanes that some light reaches */
} Illumination;

static Lanes at_least_zero(Lanes x) { return x > (Lanes)0 ? x : (Lanes)0; }

INLINE Vec scale_colour(Lanes s, real3 c) { return vec(s * c.x, s * c.y, s * c.z); }

/* What shows in the shadow of a light whose ambient term counts there. */
INLINE Vec shine_in_shadow(const LightTerms *terms)
{
    return vec((Lanes)terms->ambient.x, (Lanes)terms->ambient.y, (Lanes)terms->ambient.z);
}

/* What shows in the light. l, v: unit vectors to the light and to the viewer. */
INLINE Vec shine(const LightTerms *terms, Vec l, Vec v, Vec normal)
{
    Lanes diffuse = at_least_zero(vec_dot(l, normal));
    Vec sum = vec_add(shine_in_shadow(terms), scale_colour(diffuse, terms->diffuse));
    if (!terms->has_highlight)
        return sum;
    Vec half_way = vec_unit(vec_add(l, v));
    Lanes highlight = power(at_least_zero(vec_dot(normal, half_way)), terms->exponent);
    return vec_add(sum, scale_colour(highlight, terms->specular));
}

INLINE void light_position(global const real *light, wide *position)
{
    for (int axis = 0; axis < 3; axis++)
        position[axis] = (wide)light[LIGHT_POSITION + axis] + (wide)light[LIGHT_POSITION_LOW + axis];
}

/* Does it matter what a light reaches? Not if it has an ambient colour only, and that counts in its shadow, too. */
INLINE bool wants_light(const World *world, global const real *light)
{
    bool only_ambient = true;
    for (int i = 0; i < 3; i++)
        only_ambient &= light[LIGHT_DIFFUSE + i] == 0 && light[LIGHT_SPECULAR + i] == 0;
    return !(MAY_SKIP(world->parameters, SKIP_LIGHT_AMBIENT) && world->parameters->shadow_ambient && only_ambient);
}
