/* The exact arithmetic of the plain kernel. It promises that rounding decides nothing:
 * - each yes or no (parallel, behind, inside, in front of a plane, blocked) is that of the numbers as they are stored;
 * - a shifted point lies on its side of the face, so that no ray meets the face that it leaves.
 * Values are rounded as usual; where their rounding error might hide the sign, shared/exact.cl finds it.
 * docs/algorithm.md, sections 3 to 6, has the formulas, docs/bounds.md the proofs; src/scene/geometry.c is the same in
 * C. */
#include "shared/layout.h"
#include "shared/precision.cl"
#include "shared/exact.cl"
#include "plain/scene.cl"
#include "plain/box.cl"

static wide sum_of_magnitudes(wide3 a) { return fabs(a.x) + fabs(a.y) + fabs(a.z); }

/* a - b without error. */
static Exact exact_between(wide3 a, wide3 b)
{
    wide to[3] = {a.x, a.y, a.z}, from[3] = {b.x, b.y, b.z};
    return exact_difference(to, from);
}

/* How far arithmetic in twice the precision may be from N.x. */
static wide accurate_bound(const Scene *scene, int face, wide3 x)
{
    return (plane_row(scene, face)[PLANE_ERROR] + 64 * WIDE_ROUNDING * WIDE_ROUNDING) * sum_of_magnitudes(x);
}

/* N.x in twice the precision, and exactly where that leaves few bits. The sign is always exact. */
static Pair normal_dot_accurate(const Scene *scene, int face, Exact x)
{
    global const wide *plane = plane_row(scene, face);
    wide3 n = face_normal(scene, face), n_low = vload3(0, plane + PLANE_NORMAL_LOW);
    wide3 high = (wide3)(x.x.high, x.y.high, x.z.high), low = (wide3)(x.x.low, x.y.low, x.z.low);
    Pair xs = two_product(n.x, high.x), ys = two_product(n.y, high.y), zs = two_product(n.z, high.z);
    Pair xy = two_sum(xs.high, ys.high), xyz = two_sum(xy.high, zs.high);
    wide rest = xy.low + xyz.low + (xs.low + ys.low + zs.low) + (vec3_dot(n_low, high) + vec3_dot(n, low));
    Pair value = two_sum(xyz.high, rest);
    if (fabs(value.high) > PAIRS_LIMIT * accurate_bound(scene, face, high))
        return value;
    value.high = cross_dot(face_row(scene, face), &x) / plane[PLANE_LENGTH];
    value.low = 0;
    return value;
}

/* The sign of N.(a - b), exact. */
static int normal_sign(const Scene *scene, int face, wide3 a, wide3 b)
{
    wide3 x = a - b;
    wide value = vec3_dot(face_normal(scene, face), x);
    if (fabs(value) <= (plane_row(scene, face)[PLANE_ERROR] + 8 * WIDE_ROUNDING) * sum_of_magnitudes(x))
        value = normal_dot_accurate(scene, face, exact_between(a, b)).high;
    return (value > 0) - (value < 0);
}

/* The side of the face's plane that the point lies on: +1 where N points, 0 in the plane, -1 behind. */
static int plane_side(const Scene *scene, int face, wide3 point)
{
    return normal_sign(scene, face, point, face_vertex(scene, face, 0));
}

/* Step 4: does the line along r pass inside all edges? The signs of det(R, v[k] - O, v[k+1] - O) need no hit point. */
static bool inside_edges(const Scene *scene, int face, wide3 o, Exact r)
{
    wide origin[3] = {o.x, o.y, o.z};
    return inside_sign(face_row(scene, face), origin, &r) != 0;
}

/* t = -N.(O - v0) / N.R with an error of little more than half an ulp. */
static wide accurate_t(const Scene *scene, int face, Ray ray)
{
    Pair distance = normal_dot_accurate(scene, face, exact_between(ray.origin, face_vertex(scene, face, 0)));
    Pair approach = normal_dot_accurate(scene, face, exact_between(ray.direction, (wide3)0));
    wide q = distance.high / approach.high;
    wide rest = fma(-q, approach.high, distance.high) + (distance.low - q * approach.low);
    return -(isfinite(q) ? q + rest / approach.high : q);
}

/* Steps 3 and 4: does the ray hit the face? */
static bool face_test(Scene *scene, int face, Ray ray, Hit *hit)
{
    if (face == ray.from)
        return false;
    scene->counts[COUNT_FACE_TESTS]++;
    int towards = normal_sign(scene, face, ray.direction, (wide3)0), start = plane_side(scene, face, ray.origin);
    if (towards * start >= 0) /* parallel, or behind the origin */
        return false;
    hit->from_behind = towards > 0;
    if ((hit->from_behind && is_one_sided(scene, face)) ||
        !inside_edges(scene, face, ray.origin, exact_between(ray.direction, (wide3)0)))
        return false;
    Interval in_box = interval_in_box(scene->faces[face].box, 1, ray);
    hit->face = face;
    hit->t = accurate_t(scene, face, ray);
    hit->t_in_box = fmin(fmax(hit->t, in_box.enter), in_box.leave);
    return isfinite(hit->t) && in_box.enter <= in_box.leave;
}

/* Step 6: is the face strictly between the ray's origin and `end`, where t = 1? Then its plane parts them. */
static bool face_blocks(Scene *scene, int face, Ray ray, wide3 end)
{
    if (face == ray.from)
        return false;
    scene->counts[COUNT_FACE_TESTS]++;
    int start = plane_side(scene, face, ray.origin);
    if (start * plane_side(scene, face, end) >= 0 || (start < 0 && is_one_sided(scene, face)) ||
        !inside_edges(scene, face, ray.origin, exact_between(end, ray.origin)))
        return false;
    Interval in_box = interval_in_box(scene->faces[face].box, 1, ray);
    return in_box.enter <= in_box.leave && in_box.enter <= 1;
}

/* Step 6: is the light in front of the face? All points of the face see it on the same side, so the plane decides. */
static bool faces_light(const Scene *scene, const Hit *hit, wide3 light)
{
    int side = plane_side(scene, hit->face, light);
    return hit->from_behind ? side < 0 : side > 0;
}

/* Step 6: P moved along the normal to where it is surely on that side of the plane. */
static wide3 point_shifted(const Scene *scene, const Hit *hit)
{
    wide3 v0 = face_vertex(scene, hit->face, 0);
    wide height = normal_dot_accurate(scene, hit->face, exact_between(hit->point, v0)).high;
    height = hit->from_behind ? -height : height;
    wide margin = 2 * WIDE_ROUNDING * sum_of_magnitudes(hit->point) + 12 * WIDE_ROUNDING * fabs(height) +
                  accurate_bound(scene, hit->face, hit->point - v0);
    return hit->point + (fmax(margin, (wide)SHIFT_FLOOR) - height) * hit->normal;
}
