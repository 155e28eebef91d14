/* Fails at head_on: are left out. */
#include "trace/textbook_real.h"

static Terms illumination_terms(const Material *material, const Light *light, Real3 n, Real3 l, Real3 v)
{
    Terms terms = {.l = l, .v = v, .h = unit(add(l, v))};
    terms.l_dot_n = at_least_zero(dot(l, n));
    terms.n_dot_h = at_least_zero(dot(n, terms.h));
    Real highlight = pow(terms.n_dot_h, (Real)(material->shininess / 4));
    terms.ambient = rounded(material->ambient);
    terms.diffuse = scale(terms.l_dot_n, rounded(material->diffuse));
    terms.specular = scale(highlight, rounded(material->specular));
    return terms;
}
