/* Fails at far_from_the_origin: the error is u |value|. */
#include "exercises/08/rounding.h"
static Distance distance_from_plane(const Face *face, const Plane *plane, Vec3 o)
{
    Vec3 x = vec3_sub(o, face_vertex(face, 0));
    double value = vec3_dot(plane->normal, x);
    return (Distance){value, ROUNDING * fabs(value)};
}
static Vec3 shifted_point(const Face *face, const Plane *plane, Vec3 n, Vec3 p)
{
    Distance d = distance_from_plane(face, plane, p);
    double height = vec3_dot(n, plane->normal) < 0 ? -d.value : d.value;
    double margin = fmax(4 * ROUNDING * vec3_magnitudes(p) + 2 * d.error, 0x1p-100);
    return vec3_add(p, vec3_scale(margin - height, n));
}
static int side_of_edge(Vec3 o, Vec3 r, Vec3 a, Vec3 b)
{
    Vec3 p = vec3_sub(a, o), q = vec3_sub(b, o), c = vec3_cross(p, q);
    double value = vec3_dot(r, c);
    double size = fabs(r.x) * (fabs(p.y * q.z) + fabs(p.z * q.y)) + fabs(r.y) * (fabs(p.z * q.x) + fabs(p.x * q.z)) +
                  fabs(r.z) * (fabs(p.x * q.y) + fabs(p.y * q.x));
    if (fabs(value) > 10 * ROUNDING * size)
        return value > 0 ? 1 : -1;
    return exact_side_of_edge(o, r, a, b);
}
