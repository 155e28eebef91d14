/* Exercise 6: what a light adds at a point. The README beside this file tells the task.
 *
 * What you may use, in src/trace/textbook_real.h and src/scene/scene.h:
 *     Real, Real3                             numbers and vectors; a colour has red in .x, green in .y, blue in .z
 *     add(a, b), subtract(a, b), scale(s, a), dot(a, b)
 *     multiply(a, b)                          component by component: how a surface filters the colour of a light
 *     unit(a)                                 a / |a|
 *     at_least_zero(x)                        x, or 0 if x is less
 *     pow(x, y)                               x to the power y
 *     material->ambient, ->diffuse, ->specular    ka, kd, ks
 *     material->shininess                         alpha
 *     light->ambient, ->diffuse, ->specular       ia, id, is
 *     rounded(a)                              one of these colours as a Real3: rounded(light->diffuse)
 */
#include "trace/textbook_real.h"

/* The terms of I = ka ia + kd id (L.N) + ks is (N.H)^(alpha/4), where H is the unit vector halfway between L and V.
 *
 * n is the unit normal on the viewer's side, l the unit vector to the light, v the one to the viewer.
 * A dot product that is less than 0 counts as 0. Fill
 *     terms.l, terms.v             as they are given
 *     terms.h                      H
 *     terms.l_dot_n                L.N, at least 0
 *     terms.n_dot_h                N.H, at least 0
 *     terms.ambient, terms.diffuse, terms.specular    the three terms, which are colours */
static Terms illumination_terms(const Material *material, const Light *light, Real3 n, Real3 l, Real3 v)
{
    Terms terms = {0};
    /* Your lines. */
    return terms;
}
