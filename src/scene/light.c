/* Illumination: what one light adds at one point. */
#include "scene/light.h"

static double clamp_at_zero(double x)
{
    return x > 0 ? x : 0;
}

Illumination illuminate(const Material *material, const Light *light, Vec3 n, Vec3 l, Vec3 v)
{
    Illumination result = {.l_dot_n = clamp_at_zero(vec3_dot(l, n))};
    Vec3 halfway = vec3_add(l, v);
    if (vec3_dot(halfway, halfway) > 0) /* L = -V: no halfway direction, no highlight */
        result.h = vec3_unit(halfway);
    result.n_dot_h = clamp_at_zero(vec3_dot(n, result.h));
    double highlight = pow(result.n_dot_h, material->shininess / 4);

    result.ambient = vec3_multiply(material->ambient, light->ambient);
    result.diffuse = vec3_scale(result.l_dot_n, vec3_multiply(material->diffuse, light->diffuse));
    result.specular = vec3_scale(highlight, vec3_multiply(material->specular, light->specular));
    return result;
}

bool colour_is_black(Vec3 colour)
{
    return colour.x == 0 && colour.y == 0 && colour.z == 0;
}

unsigned char colour_to_byte(double c)
{
    c = c < 0 ? 0 : c > 1 ? 1 : c;
    return (unsigned char)floor(255 * c + 0.5);
}
