/* Fails at from_the_side: multiplied by L.N, too. */
#include "trace/textbook_real.h"

static Terms illumination_terms(const Material *material, const Light *light, Real3 n, Real3 l, Real3 v)
{
    Terms terms = {.l = l, .v = v, .h = unit(add(l, v))};
    terms.l_dot_n = at_least_zero(dot(l, n));
    terms.n_dot_h = at_least_zero(dot(n, terms.h));
    Real highlight = pow(terms.n_dot_h, (Real)(material->shininess / 4));
    terms.ambient = multiply(rounded(material->ambient), rounded(light->ambient));
    terms.diffuse = scale(terms.l_dot_n, multiply(rounded(material->diffuse), rounded(light->diffuse)));
    terms.specular = scale(terms.l_dot_n * highlight, multiply(rounded(material->specular), rounded(light->specular)));
    return terms;
}
