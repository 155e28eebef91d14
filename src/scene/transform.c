/* Affine transforms. */
#include "scene/transform.h"

Transform transform_scale(Vec3 factors)
{
    return (Transform){.rows = {{factors.x, 0, 0}, {0, factors.y, 0}, {0, 0, factors.z}}};
}

Transform transform_identity(void)
{
    return transform_scale(vec3(1, 1, 1));
}

Transform transform_translate(Vec3 offset)
{
    Transform transform = transform_identity();
    transform.offset = offset;
    return transform;
}

/* sin and cos of an angle in degrees. The angle is first brought to -45..45 degrees around a quarter turn, exactly, so
 * that sin 180 and cos 90 are 0 and not 1e-16: a box turned by 90 degrees stays aligned with the axes. */
static void sine_cosine(double degrees, double *sine, double *cosine)
{
    int quarter;
    double rest = remquo(degrees, 90, &quarter) * (3.14159265358979323846 / 180);
    double s = sin(rest), c = cos(rest);
    switch (quarter & 3) {
    case 0:
        *sine = s, *cosine = c;
        break;
    case 1:
        *sine = c, *cosine = -s;
        break;
    case 2:
        *sine = -s, *cosine = -c;
        break;
    default:
        *sine = -c, *cosine = s;
        break;
    }
}

Transform transform_rotate(Vec3 axis, double degrees)
{
    /* A power of two first: the squares of an axis such as (1e200, 0, 0) would overflow. */
    Vec3 k = vec3_unit(vec3_ldexp(axis, -vec3_exponent(axis)));
    double s, c;
    sine_cosine(degrees, &s, &c);
    Vec3 sine_k = vec3_scale(s, k), rest_k = vec3_scale(1 - c, k);
    return (Transform){.rows = {
                           {c + rest_k.x * k.x, rest_k.x * k.y - sine_k.z, rest_k.x * k.z + sine_k.y},
                           {rest_k.y * k.x + sine_k.z, c + rest_k.y * k.y, rest_k.y * k.z - sine_k.x},
                           {rest_k.z * k.x - sine_k.y, rest_k.z * k.y + sine_k.x, c + rest_k.z * k.z},
                       }};
}

Transform transform_then(Transform first, Transform next)
{
    Transform both;
    for (int i = 0; i < 3; i++) {
        Vec3 row = next.rows[i];
        both.rows[i] = vec3_add(vec3_add(vec3_scale(row.x, first.rows[0]), vec3_scale(row.y, first.rows[1])),
                                vec3_scale(row.z, first.rows[2]));
    }
    both.offset = transform_point(&next, first.offset);
    return both;
}

Vec3 transform_point(const Transform *transform, Vec3 point)
{
    const Vec3 *rows = transform->rows;
    return vec3_add(vec3(vec3_dot(rows[0], point), vec3_dot(rows[1], point), vec3_dot(rows[2], point)),
                    transform->offset);
}

bool transform_mirrors(const Transform *transform)
{
    const Vec3 *rows = transform->rows;
    return vec3_dot(rows[0], vec3_cross(rows[1], rows[2])) < 0;
}
