/* Eight faces at a time. A loop does one step for all lanes; what a step leaves for the next one stays in an array. */
#include "scene/face_lanes.h"

#include "scene/exact.h"
#include "scene/shape.h"

#include <float.h>
#include <stdbool.h>

#define ROUNDING (DBL_EPSILON / 2)

/* Coordinates beyond this need a closer look: the squares of their products might overflow. */
#define LARGEST 1e70

static inline double larger(double a, double b)
{
    return a > b ? a : b;
}

static inline Vec3 vertex(const FaceLanes *faces, int k, int lane)
{
    return vec3(faces->x[k][lane], faces->y[k][lane], faces->z[k][lane]);
}

static inline double largest(Vec3 a)
{
    return larger(fabs(a.x), larger(fabs(a.y), fabs(a.z)));
}

static inline int same(Vec3 a, Vec3 b)
{
    return (a.x == b.x) & (a.y == b.y) & (a.z == b.z);
}

/* The triangle at the corner b, between a and c, turns the other way than the face. */
static inline int turns(Vec3 a, Vec3 b, Vec3 c, Vec3 normal, double least)
{
    return vec3_dot(vec3_cross(vec3_sub(b, a), vec3_sub(c, b)), normal) < least;
}

static unsigned bits_of(const int *doubt)
{
    unsigned bits = 0;
    for (int l = 0; l < FACE_LANES; l++)
        bits |= doubt[l] ? 1u << l : 0;
    return bits;
}

static inline int quad_doubt(Vec3 a, Vec3 b, Vec3 c, Vec3 d)
{
    Vec3 first = vec3_sub(c, a), second = vec3_sub(d, b), normal = vec3_cross(first, second);
    double size = larger(larger(largest(a), largest(b)), larger(largest(c), largest(d)));
    double diagonal = larger(vec3_length(first), vec3_length(second)), area = vec3_length(normal);
    double distance = fabs(vec3_dot(normal, vec3_sub(b, a))) / area;
    double least = -SHAPE_STRAIGHTNESS * vec3_dot(normal, normal);
    return same(a, b) | same(a, c) | same(a, d) | same(b, c) | same(b, d) | same(c, d) | !(size <= LARGEST) |
           !(area > 16 * DBL_EPSILON * size * diagonal) | !(distance <= SHAPE_PLANARITY * diagonal) |
           turns(d, a, b, normal, least) | turns(a, b, c, normal, least) | turns(b, c, d, normal, least) |
           turns(c, d, a, normal, least);
}

static inline int triangle_doubt(Vec3 a, Vec3 b, Vec3 c)
{
    Vec3 first = vec3_sub(b, a), second = vec3_sub(c, a);
    double size = larger(largest(a), larger(largest(b), largest(c)));
    double side = larger(vec3_length(first), larger(vec3_length(second), vec3_length(vec3_sub(c, b))));
    return same(a, b) | same(a, c) | same(b, c) | !(size <= LARGEST) |
           !(vec3_length(vec3_cross(first, second)) > 16 * DBL_EPSILON * size * side);
}

void face_lanes_grow(const FaceLanes *restrict faces, BoundLanes *restrict bounds)
{
    for (int k = 0; k < FACE_VERTICES_MOST; k++) {
        const double *const coordinates[3] = {faces->x[k], faces->y[k], faces->z[k]};
        for (int axis = 0; axis < 3; axis++)
            for (int l = 0; l < FACE_LANES; l++) {
                double at = coordinates[axis][l];
                bounds->low[axis][l] = at < bounds->low[axis][l] ? at : bounds->low[axis][l];
                bounds->high[axis][l] = at > bounds->high[axis][l] ? at : bounds->high[axis][l];
            }
    }
}

FOR_EVERY_PROCESSOR
unsigned face_lanes_shapes(const FaceLanes *faces)
{
    int doubt[FACE_LANES];
    if (faces->count == 4)
        for (int l = 0; l < FACE_LANES; l++)
            doubt[l] = quad_doubt(vertex(faces, 0, l), vertex(faces, 1, l), vertex(faces, 2, l), vertex(faces, 3, l));
    else
        for (int l = 0; l < FACE_LANES; l++)
            doubt[l] = triangle_doubt(vertex(faces, 0, l), vertex(faces, 1, l), vertex(faces, 2, l));
    return bits_of(doubt);
}

FOR_EVERY_PROCESSOR
unsigned face_lanes_round(FaceLanes *faces, Vec3 centre, double limit)
{
    int doubt[FACE_LANES] = {0};
    for (int k = 0; k < FACE_VERTICES_MOST; k++)
        for (int l = 0; l < FACE_LANES; l++) {
            Vec3 p = vec3_sub(vertex(faces, k, l), centre);
            doubt[l] |= !(largest(p) <= limit);
            faces->x[k][l] = (double)(float)p.x;
            faces->y[k][l] = (double)(float)p.y;
            faces->z[k][l] = (double)(float)p.z;
        }
    return bits_of(doubt);
}

static inline int rounded_doubt(const FaceLanes *faces, int lane)
{
    Vec3 a = vertex(faces, 0, lane), b = vertex(faces, 1, lane), c = vertex(faces, 2, lane);
    Vec3 d = vertex(faces, 3, lane), normal = vec3_cross(vec3_sub(c, a), vec3_sub(d, b));
    double least = -SHAPE_ROUNDED_STRAIGHTNESS * vec3_dot(normal, normal);
    int triangle = same(a, b) | same(a, c) | same(b, c) | (largest(normal) == 0);
    int quad = same(a, d) | same(b, d) | same(c, d) | turns(d, a, b, normal, least) | turns(a, b, c, normal, least) |
               turns(b, c, d, normal, least) | turns(c, d, a, normal, least);
    return triangle | (quad & (faces->count == 4));
}

/* a b - c d to twice the precision of a double. */
static inline Pair difference_of_products(double a, double b, double c, double d)
{
    Pair ab = exact_product(a, b), cd = exact_product(c, d), difference = exact_sum(ab.high, -cd.high);
    return exact_sum(difference.high, difference.low + (ab.low - cd.low));
}

/* fma(-quotient, divisor, high) without the instruction: a remainder fits a double, so that the difference of `high`
 * and an exact product has no error either (Sterbenz's lemma). */
static inline double quotient_low(double quotient, Pair value, double divisor)
{
    Pair back = exact_product(quotient, divisor);
    return (((value.high - back.high) - back.low) + value.low) / divisor;
}

FOR_EVERY_PROCESSOR
unsigned face_lanes_planes(const FaceLanes *restrict faces, PlaneLanes *restrict planes)
{
    int doubt[FACE_LANES];
    for (int l = 0; l < FACE_LANES; l++)
        doubt[l] = rounded_doubt(faces, l);
    for (int l = 0; l < FACE_LANES; l++) { /* as face_plane */
        Vec3 corner = vertex(faces, 0, l);
        ExactVec3 a = exact_difference(vertex(faces, 2, l), corner);
        ExactVec3 b = exact_difference(vertex(faces, 3, l), vertex(faces, 1, l));
        Pair x = difference_of_products(a.high.y, b.high.z, a.high.z, b.high.y);
        Pair y = difference_of_products(a.high.z, b.high.x, a.high.x, b.high.z);
        Pair z = difference_of_products(a.high.x, b.high.y, a.high.y, b.high.x);
        Vec3 low = vec3_add(vec3_cross(a.low, b.high), vec3_cross(a.high, b.low));
        x = exact_sum(x.high, x.low + low.x);
        y = exact_sum(y.high, y.low + low.y);
        z = exact_sum(z.high, z.low + low.z);
        double length = vec3_length(vec3(x.high, y.high, z.high));
        Vec3 normal = vec3(x.high / length, y.high / length, z.high / length);
        planes->normal[0][l] = normal.x;
        planes->normal[1][l] = normal.y;
        planes->normal[2][l] = normal.z;
        planes->normal_low[0][l] = quotient_low(normal.x, x, length);
        planes->normal_low[1][l] = quotient_low(normal.y, y, length);
        planes->normal_low[2][l] = quotient_low(normal.z, z, length);
        planes->d[l] = -vec3_dot(normal, corner);
        planes->error[l] = 16 * ROUNDING * ROUNDING * (1 + vec3_length(a.high) * vec3_length(b.high) / length);
        planes->length[l] = length;
    }
    for (int l = 0; l < FACE_LANES; l++)
        doubt[l] |= !(planes->length[l] > 0);
    return bits_of(doubt);
}
