/* Slips of step 6: the normal, the shifted point, the shadow ray. */
#include "grade/slip.h"

#include <stddef.h>

/* --- Where the point is --- */

static Vec3 normal_as_stored(const Scene *scene, const SlipHit *hit)
{
    return scene->planes[hit->face].normal;
}

static Vec3 normal_turned_away(const Scene *scene, const SlipHit *hit)
{
    Vec3 n = scene->planes[hit->face].normal;
    return hit->test.n_dot_r > 0 ? n : vec3_negate(n);
}

static Vec3 normal_not_unit(const Scene *scene, const SlipHit *hit)
{
    const Plane *plane = &scene->planes[hit->face];
    return vec3_scale(hit->test.n_dot_r > 0 ? -plane->length : plane->length, plane->normal);
}

static Vec3 point_minus(const Scene *scene, Ray ray, double t)
{
    (void)scene;
    return vec3_sub(ray.origin, vec3_scale(t, ray.direction));
}

/* The file's origin is elsewhere than the traced scene's. */
static Vec3 origin_forgotten(const Scene *scene, Ray ray, double t)
{
    return vec3_sub(vec3_scale(t, ray.direction), scene->centre);
}

/* As seen from P, which may be off the plane. */
static int side_of_point(const Scene *scene, const SlipHit *hit, int light)
{
    return vec3_dot(hit->normal, vec3_sub(scene->lights[light].position, hit->point)) > 0 ? 1 : -1;
}

/* As seen along the normal as it is stored. */
static int side_of_stored(const Scene *scene, const SlipHit *hit, int light)
{
    return plane_side(&scene->faces[hit->face], &scene->planes[hit->face], scene->lights[light].position);
}

static int side_turned_away(const Scene *scene, const SlipHit *hit, int light)
{
    return -slip_steps_side(scene, hit, light);
}

static int in_plane_counts(const Scene *scene, const SlipHit *hit, int light)
{
    int side = slip_steps_side(scene, hit, light);
    return side == 0 ? 1 : side;
}

static int any_side(const Scene *scene, const SlipHit *hit, int light)
{
    (void)scene;
    (void)hit;
    (void)light;
    return 1;
}

static Vec3 shifted_along(const SlipHit *hit, double length)
{
    return vec3_add(hit->point, vec3_scale(length, hit->normal));
}

static Vec3 shifted_by_textbook(const Scene *scene, const SlipHit *hit)
{
    (void)scene;
    return shifted_along(hit, (double)SCENE_SHIFT);
}

static Vec3 shifted_far(const Scene *scene, const SlipHit *hit)
{
    (void)scene;
    return shifted_along(hit, 1e-3);
}

static Vec3 shifted_into(const Scene *scene, const SlipHit *hit)
{
    (void)scene;
    return shifted_along(hit, -(double)SCENE_SHIFT);
}

/* --- What is in the way --- */

static FaceTest nothing_between(const Scene *scene, int face, Vec3 from, Vec3 to)
{
    (void)scene;
    (void)face;
    (void)from;
    (void)to;
    return (FaceTest){.verdict = FACE_OUTSIDE};
}

static FaceTest on_ray(const Scene *scene, int face, Vec3 from, Vec3 direction)
{
    return face_test(&scene->faces[face], &scene->planes[face], (Ray){from, direction}, HUGE_VAL, false);
}

static FaceTest beyond_light_too(const Scene *scene, int face, Vec3 from, Vec3 to)
{
    return on_ray(scene, face, from, vec3_sub(to, from));
}

static FaceTest within(FaceTest test, double low, double high)
{
    if (!(test.t > low && test.t < high))
        test.verdict = FACE_FARTHER;
    return test;
}

static FaceTest only_beyond_light(const Scene *scene, int face, Vec3 from, Vec3 to)
{
    return within(on_ray(scene, face, from, vec3_sub(to, from)), 1, HUGE_VAL);
}

static FaceTest within_a_unit(const Scene *scene, int face, Vec3 from, Vec3 to)
{
    return within(on_ray(scene, face, from, vec3_unit(vec3_sub(to, from))), 0, 1);
}

static FaceTest within_the_distance(const Scene *scene, int face, Vec3 from, Vec3 to)
{
    Vec3 way = vec3_sub(to, from);
    return within(on_ray(scene, face, from, way), 0, vec3_length(way));
}

static FaceTest away_from_light(const Scene *scene, int face, Vec3 from, Vec3 to)
{
    return on_ray(scene, face, from, vec3_sub(from, to));
}

static FaceTest along_position(const Scene *scene, int face, Vec3 from, Vec3 to)
{
    return within(on_ray(scene, face, from, vec3_add(to, scene->centre)), 0, 1);
}

/* The point's own face is in the way: rounding has put some points behind it. Grading sees those where it does. */
static FaceTest own_face_between(const Scene *scene, int face, Vec3 from, Vec3 to)
{
    Vec3 height = vec3_sub(from, face_vertex(&scene->faces[face], 0));
    double above = vec3_dot(scene->planes[face].normal, height);
    FaceTest test = face_test_segment(&scene->faces[face], &scene->planes[face], from, to, false);
    if (fabs(above) <= 1e-9 * (1 + vec3_magnitudes(height)))
        test.verdict = FACE_INSIDE;
    return test;
}

static Vec3 not_shifted(const Scene *scene, const SlipHit *hit)
{
    (void)scene;
    return hit->point;
}

#define PLANE "algorithm.md#3-the-plane-hit"
#define READ "algorithm.md#6-shadows"

const Slip slip_light[] = {
    {"shadow-beyond-light", "The shadow ray does not stop at the light: a face beyond it blocks it.",
     "a face is in the way where 0 < t < 1, with R = light - S", "a face is in the way where 0 < t", READ,
     .steps = {.between = beyond_light_too}},
    {"no-shadows", "Nothing blocks a light: the shadow ray is not sent, or its answer is not used.",
     "a light reaches P if no face is between", "a light reaches every P that faces it", READ,
     .steps = {.between = nothing_between}},
    {"shadow-unit-t", "The shadow ray's direction is a unit vector, but t is compared with 1.",
     "R = light - S and t < 1", "R = unit(light - S) and t < 1", READ, .steps = {.between = within_a_unit}},
    {"shadow-t-distance", "t of the shadow ray is compared with the distance, but its direction is no unit vector.",
     "R = light - S and t < 1", "R = light - S and t < |light - S|", READ, .steps = {.between = within_the_distance}},
    {"shadow-only-beyond", "Only a face beyond the light blocks it.", "0 < t < 1", "t > 1", READ,
     .steps = {.between = only_beyond_light}},
    {"shadow-backwards", "The shadow ray runs away from the light.", "R = light - S", "R = S - light", READ,
     .steps = {.between = away_from_light}},
    {"shadow-to-position", "The light's position is taken for the shadow ray's direction.", "R = light - S",
     "R = light", READ, .steps = {.between = along_position}},
    {"shadow-not-shifted", "The shadow ray starts at P itself, and meets its own face: P lies in shadow of itself.",
     "the shadow ray starts at S, P moved off its face", "the shadow ray starts at P", READ,
     .steps = {.between = own_face_between, .shifted = not_shifted}},
    {"shift-inwards", "The shifted point is on the wrong side of its face.", "S = P + a little n", "S = P - a little n",
     READ, .steps = {.shifted = shifted_into}},
    {"point-minus", "P lies on the wrong side of O.", "P = O + t R", "P = O - t R", PLANE,
     .steps = {.point = point_minus, .side = side_of_point, .shifted = shifted_by_textbook}},
    {"origin-forgotten", "The origin of the ray is not added.", "P = O + t R", "P = t R", PLANE,
     .steps = {.point = origin_forgotten, .side = side_of_point, .shifted = shifted_by_textbook}},
    {"normal-not-turned", "The normal is not turned to the side that the ray came from.", "n = -N where N.R > 0",
     "n = N", READ, .steps = {.normal = normal_as_stored, .side = side_of_stored}},
    {"normal-not-turned-for-light", "The normal is not turned to the viewer where it is asked for the light's side.",
     "n.(light - v0) > 0 with n turned", "N.(light - v0) > 0", READ, .steps = {.side = side_of_stored}},
    {"normal-turned-away", "The normal is turned away from the side that the ray came from.", "n = -N where N.R > 0",
     "n = -N where N.R < 0", READ, .steps = {.normal = normal_turned_away, .side = side_turned_away}},
    {"normal-not-unit", "The normal is not made a unit vector.", "N = unit(a x b)", "N = a x b",
     "algorithm.md#2-faces-and-their-planes", .steps = {.normal = normal_not_unit}},
    {"light-in-plane-counts", "A light in the face's own plane lights it.", "n.(light - v0) > 0", "n.(light - v0) >= 0",
     READ, .steps = {.side = in_plane_counts}},
    {"light-behind-counts", "A light behind the face is not left out.", "n.(light - v0) > 0, else no light",
     "the shadow ray alone decides", READ, .steps = {.side = any_side}},
    {"rounding", "No slip: your arithmetic rounds otherwise, and here rounding decides.",
     "the shift is found for each point", "a shift of 1e-5", "rounding.md#what-to-remember", .rounding = true,
     .steps = {.shifted = shifted_by_textbook}},
    {"shift-long", "No slip: points are shifted so far that it shows here.", "the shift is found for each point",
     "a shift of 1e-3", "rounding.md#what-to-remember", .rounding = true, .steps = {.shifted = shifted_far}},
    {0},
};
