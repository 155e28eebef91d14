/* The steps done rightly. The numbers in the comments are those of docs/algorithm.md. */
#include "grade/slip_steps.h"

/* 1. The centre of the sub-pixel. */
static ScreenPoint screen_point(const View *view, const Event *sample)
{
    return view_screen_point(view, sample->as.sample.column, sample->as.sample.row, sample->as.sample.i,
                             sample->as.sample.j);
}

/* 1. R = Q - C. */
static Vec3 direction(const View *view, ScreenPoint at)
{
    return vec3_add(vec3_add(view->forward, vec3_scale(at.x, view->right)), vec3_scale(at.y, view->up));
}

/* 3 and 4. */
static FaceTest test(const Scene *scene, int face, Ray ray)
{
    return face_test(&scene->faces[face], &scene->planes[face], ray, HUGE_VAL, false);
}

/* 5. */
static bool nearer(const SlipHit *nearest, double t)
{
    return nearest->face < 0 || t < nearest->test.t_in_box;
}

/* 3. P = O + t R. */
static Vec3 point(const Scene *scene, Ray ray, double t)
{
    (void)scene;
    return vec3_add(ray.origin, vec3_scale(t, ray.direction));
}

/* 6. N turned to the side that the ray came from. */
static Vec3 normal(const Scene *scene, const SlipHit *hit)
{
    Vec3 n = scene->planes[hit->face].normal;
    return hit->test.n_dot_r > 0 ? vec3_negate(n) : n;
}

/* 6. */
static Vec3 shifted(const Scene *scene, const SlipHit *hit)
{
    return point_shifted(&scene->faces[hit->face], &scene->planes[hit->face], hit->normal, hit->point);
}

/* 6. */
int slip_steps_side(const Scene *scene, const SlipHit *hit, int light)
{
    int side = plane_side(&scene->faces[hit->face], &scene->planes[hit->face], scene->lights[light].position);
    return hit->test.n_dot_r > 0 ? -side : side;
}

/* 6. */
static FaceTest between(const Scene *scene, int face, Vec3 from, Vec3 to)
{
    return face_test_segment(&scene->faces[face], &scene->planes[face], from, to, false);
}

static Vec3 unit_or_zero(Vec3 a)
{
    return vec3_dot(a, a) > 0 ? vec3_unit(a) : a;
}

/* 7. V: to the camera, or back along the ray. */
static Vec3 viewer(const Scene *scene, const SlipHit *hit)
{
    return scene->shading.viewer == VIEWER_RAY ? vec3_negate(hit->r)
                                               : unit_or_zero(vec3_sub(scene->camera.position, hit->point));
}

/* 7. */
Illumination slip_steps_terms(const SlipShine *shine)
{
    return illuminate(&shine->material, &shine->light, shine->hit->normal, shine->l, shine->v);
}

/* 8. */
Vec3 slip_steps_lit(const SlipShine *shine, const Illumination *terms)
{
    return shine->reaches ? vec3_add(vec3_add(terms->ambient, terms->diffuse), terms->specular) : terms->ambient;
}

/* 9. */
static bool ends(const SlipEnd *end, PathEnd *reason)
{
    const Shading *shading = &end->scene->shading;
    bool dark = end->reaching == 0 && shading->shadow == SHADOW_BLACK;
    *reason = dark ? PATH_IN_SHADOW : end->material->reflection == 0 ? PATH_NOT_MIRROR : PATH_MAX_BOUNCES;
    return dark || end->material->reflection == 0 || end->bounces == shading->max_bounces;
}

/* 9. R' = r - 2 (r.N) N. */
static Ray reflected(const SlipHit *hit)
{
    return (Ray){hit->shifted, vec3_sub(hit->r, vec3_scale(2 * vec3_dot(hit->r, hit->normal), hit->normal))};
}

/* 9. */
static double weight(double before, double reflection)
{
    return before * reflection;
}

/* 9. */
static Vec3 contribution(double weight_of_hit, Vec3 illumination, const Material *material)
{
    (void)material;
    return vec3_scale(weight_of_hit, illumination);
}

/* 10. */
static Vec3 average(Vec3 sum, int samples)
{
    return vec3(sum.x / samples, sum.y / samples, sum.z / samples);
}

/* 10. */
static void bytes(Vec3 colour, unsigned char rgb[3])
{
    rgb[0] = colour_to_byte(colour.x);
    rgb[1] = colour_to_byte(colour.y);
    rgb[2] = colour_to_byte(colour.z);
}

#define OR_RIGHT(step, right) steps.step = steps.step ? steps.step : (right)

SlipSteps slip_steps_of(const SlipSteps *slip)
{
    SlipSteps steps = *slip;
    OR_RIGHT(view, view_of);
    OR_RIGHT(screen_point, screen_point);
    OR_RIGHT(direction, direction);
    OR_RIGHT(test, test);
    OR_RIGHT(nearer, nearer);
    OR_RIGHT(point, point);
    OR_RIGHT(normal, normal);
    OR_RIGHT(shifted, shifted);
    OR_RIGHT(side, slip_steps_side);
    if (!slip->test || slip->shadows_apart)
        OR_RIGHT(between, between);
    OR_RIGHT(to_light, unit_or_zero);
    OR_RIGHT(viewer, viewer);
    OR_RIGHT(terms, slip_steps_terms);
    OR_RIGHT(lit, slip_steps_lit);
    OR_RIGHT(add_light, vec3_add);
    OR_RIGHT(ends, ends);
    OR_RIGHT(reflected, reflected);
    OR_RIGHT(weight, weight);
    OR_RIGHT(contribution, contribution);
    OR_RIGHT(miss, vec3_scale);
    OR_RIGHT(add_hit, vec3_add);
    OR_RIGHT(average, average);
    OR_RIGHT(bytes, bytes);
    return steps;
}
