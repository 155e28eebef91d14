/* The verdict on a face's shape. */
#include "scene/shape.h"

#include <float.h>
#include <stdbool.h>

static bool same_point(Vec3 a, Vec3 b)
{
    return a.x == b.x && a.y == b.y && a.z == b.z;
}

/* Twice the area that rounding errors of half an ulp in each coordinate can give to points on one line: an error of
 * `size` * DBL_EPSILON in each of two sides of up to `diagonal`, in three products each. */
static double area_noise(const Vec3 *v, int count, double diagonal)
{
    double size = 0;
    for (int i = 0; i < count; i++)
        size = fmax(size, vec3_largest(v[i]));
    return 16 * DBL_EPSILON * size * diagonal;
}

static Shape measure(const Vec3 *v, int count)
{
    Shape shape = {.verdict = SHAPE_GOOD};
    for (int i = 0; i < count; i++)
        if (!vec3_is_finite(v[i])) {
            shape.verdict = SHAPE_NOT_FINITE;
            shape.first = i;
            return shape;
        }
    for (int i = 0; i < count; i++)
        for (int j = i + 1; j < count; j++) {
            if (same_point(v[i], v[j])) {
                shape.verdict = SHAPE_REPEATED;
                shape.first = i;
                shape.second = j;
                return shape;
            }
            if (count == 3 || j == i + 2)
                shape.diagonal = fmax(shape.diagonal, vec3_length(vec3_sub(v[j], v[i])));
        }
    return shape;
}

/* The triangles at the corners of a convex quad all turn the same way. One that turns the other way is a reflex corner,
 * two are a bow-tie. normal: the cross product of the diagonals, twice the area long. */
static void check_corners(Shape *shape, const Vec3 *v, Vec3 normal, double tolerance)
{
    int wrong = 0;
    for (int i = 0; i < 4; i++) {
        Vec3 before = vec3_sub(v[i], v[(i + 3) % 4]), after = vec3_sub(v[(i + 1) % 4], v[i]);
        if (vec3_dot(vec3_cross(before, after), normal) < -tolerance * vec3_dot(normal, normal)) {
            if (wrong++ == 0)
                shape->first = i;
        }
    }
    if (wrong)
        shape->verdict = wrong == 1 ? SHAPE_CONCAVE : SHAPE_CROSSED;
}

Shape shape_of(const Vec3 *v, int count)
{
    Shape shape = measure(v, count);
    if (shape.verdict)
        return shape;
    double noise = area_noise(v, count, shape.diagonal);
    Vec3 first_half = vec3_cross(vec3_sub(v[1], v[0]), vec3_sub(v[2], v[0]));
    if (count == 3) {
        if (vec3_length(first_half) <= noise)
            shape.verdict = SHAPE_NO_AREA;
        return shape;
    }
    Vec3 normal = vec3_cross(vec3_sub(v[2], v[0]), vec3_sub(v[3], v[1]));
    double area = vec3_length(normal);
    if (area <= noise) { /* parallel diagonals: all on one line, or the bow-tie whose halves cancel */
        shape.verdict = vec3_length(first_half) <= noise ? SHAPE_NO_AREA : SHAPE_CROSSED;
        return shape;
    }
    /* Vertex 2 lies in the plane, and vertices 1 and 3 are equally far from it, since N is normal to both diagonals. */
    shape.distance = fabs(vec3_dot(normal, vec3_sub(v[1], v[0]))) / area;
    shape.first = 1;
    if (shape.distance > SHAPE_PLANARITY * shape.diagonal)
        shape.verdict = SHAPE_NOT_PLANAR;
    else
        check_corners(&shape, v, normal, SHAPE_STRAIGHTNESS);
    return shape;
}

Shape shape_of_rounded(const Vec3 *v, int count)
{
    Shape shape = measure(v, count);
    if (shape.verdict)
        return shape;
    Vec3 normal = vec3_cross(vec3_sub(v[2], v[0]), vec3_sub(v[count == 3 ? 0 : 3], v[1]));
    if (vec3_largest(normal) == 0)
        shape.verdict = SHAPE_NO_AREA;
    else if (count == 4)
        check_corners(&shape, v, normal, SHAPE_ROUNDED_STRAIGHTNESS);
    return shape;
}
