/* Exercise 8: three answers that rounding cannot turn round. The README beside this file tells the task.
 *
 * What you may use, all of it short, in src/base/vec3.h and src/scene/geometry.h:
 *     Vec3                                         a point or a vector, with .x, .y and .z, all of them doubles
 *     vec3_add(a, b), vec3_sub(a, b)               a + b, a - b
 *     vec3_scale(s, a), vec3_dot(a, b)             s a, a.b
 *     vec3_cross(a, b)                             a x b
 *     vec3_magnitudes(a)                           |x| + |y| + |z|
 *     fabs(s), fmax(s, t)                          |s|, the larger one
 *     plane->normal                                N, the unit normal, each number of it rounded
 *     face_vertex(face, k)                         v[k] of the face, exactly
 * and from the tests:
 *     ROUNDING                                     u = 2^-53: a rounded result is at most u times itself off
 *     Distance                                     what the first function gives back
 *     exact_side_of_edge(o, r, a, b)               what the third function gives back, without rounding, but slowly
 */
#include "exercises/08/rounding.h"

/* N.(O - v0): how far the point o lies from the plane of the face, more than 0 on the side that N points to.
 *
 * Give back value, and error: the true distance is within value - error and value + error, always. But no pessimism:
 * error is at most 32 u |O - v0|, where |a| is vec3_magnitudes(a). */
static Distance distance_from_plane(const Face *face, const Plane *plane, Vec3 o)
{
    /* Your lines. */
    return (Distance){.value = NAN, .error = NAN};
}

/* The point p, which lies near the plane, moved along n, so that it is surely above the plane: on the side that n
 * points to. n is plane->normal or its opposite.
 *
 * p was computed, so it lies a little above the plane or below it. The point that you give back lies truly above it,
 * and at most 64 u (|P| + |P - v0|) + 1e-25 high. */
static Vec3 shifted_point(const Face *face, const Plane *plane, Vec3 n, Vec3 p)
{
    /* Your lines. */
    return p;
}

/* The sign of R.((A - O) x (B - O)): on which side of the edge from a to b does the ray from o along r pass?
 * 1: the sign is +, -1: it is -, 0: the ray meets the line of the edge.
 *
 * The sign is never wrong. exact_side_of_edge would give it, but ask it only where you must: where the rounded number
 * is at most 40 u times the same sum of products with each product's magnitude. */
static int side_of_edge(Vec3 o, Vec3 r, Vec3 a, Vec3 b)
{
    /* Your lines. */
    return 2;
}
