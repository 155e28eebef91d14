/* The textbook tracer, to be checked against docs/algorithm.md with a finger: the numbers in the comments are its
 * steps. Steps 1 to 9 are in files of their own, each one or two functions: textbook_camera.h, _plane.h, _inside.h,
 * _nearest.h, _shadow.h, _light.h and _mirror.h. Here they become a picture. All is computed in `Real`, which is double
 * here and float where textbook_float.c compiles this file once more. Vectors are in textbook_real.h. Calls of
 * `record_...` tell the walkthrough what happens. */
#include "trace/textbook.h"

#include "trace/textbook_camera.h"
#include "trace/textbook_light.h"
#include "trace/textbook_mirror.h"
#include "trace/textbook_nearest.h"
#include "trace/textbook_shadow.h"

/* 1. The ray through a sample of a pixel. */
static RealRay primary_ray(const Textbook *textbook, int column, int row, int i, int j)
{
    ScreenRay sample = camera_ray(view_of(textbook->scene), column, row, i, j);
    record_sample(textbook->recorder, (Place){column, row, i, j}, sample.x, sample.y, sample.ray);
    return sample.ray;
}

/* 6. Does the light reach the point, or is it behind the face, or a face between them? */
static bool light_reaches(const Textbook *textbook, const Hit *hit, int index)
{
    Real3 light = rounded(textbook->scene->lights[index].position);
    Real height = dot(hit->n, subtract(light, hit->p));
    record_light(textbook->recorder, hit, index, light, height);
    bool in_front = height > 0;
    textbook->report->rays.shadow += in_front;
    int blocker = in_front ? face_between(textbook, hit, light) : -1;
    LightVerdict verdict = !in_front ? LIGHT_BEHIND_FACE : blocker < 0 ? LIGHT_REACHES : LIGHT_BLOCKED;
    record_light_end(textbook->recorder, index, verdict, blocker);
    textbook->report->skipped[SKIP_LIGHT_BEHIND] += !in_front;
    return verdict == LIGHT_REACHES;
}

/* 6 to 8. The light that the point sends to the viewer. *reaching counts the lights that reach it. */
static Real3 shade(const Textbook *textbook, const Material *material, const Hit *hit, Real3 v, int *reaching)
{
    const Scene *scene = textbook->scene;
    Real3 colour = {0, 0, 0};
    *reaching = 0;
    for (int i = 0; i < scene->light_count; i++) {
        bool reaches = light_reaches(textbook, hit, i);
        *reaching += reaches;
        if (!reaches && scene->shading.shadow == SHADOW_BLACK)
            continue;
        Real3 l = unit(subtract(rounded(scene->lights[i].position), hit->p));
        Terms terms = illumination_terms(material, &scene->lights[i], hit->n, l, v);
        Real3 sum = reaches ? add(add(terms.ambient, terms.diffuse), terms.specular) : terms.ambient;
        colour = add(colour, sum);
        record_terms(textbook->recorder, material, i, &terms, sum, reaches);
    }
    return colour;
}

/* 3 to 9. The sum of the hits' illuminations, each weighted by the mirrors before it. */
static Real3 trace_path(const Textbook *textbook, RealRay ray)
{
    const Scene *scene = textbook->scene;
    const Shading *shading = &scene->shading;
    Real3 eye = ray.o, total = {0, 0, 0};
    Real weight = 1;
    for (int bounces = 0;; bounces++) {
        Hit hit = nearest_hit(textbook, ray);
        textbook->report->face_tests += (uint64_t)scene->face_count;
        if (hit.face < 0) {
            Real3 seen = scale(weight, rounded(shading->background));
            record_miss(textbook->recorder, shading->background, seen, weight);
            return end_path(textbook->recorder, PATH_MISSED, add(total, seen), bounces);
        }
        place_hit(textbook, &hit);
        record_hit(textbook->recorder, &hit, bounces);
        const Material *material = &scene->materials[scene->faces[hit.face].material];
        Real3 r = unit(ray.r), v = shading->viewer == VIEWER_RAY ? scale(-1, r) : unit(subtract(eye, hit.p));
        int reaching;
        Real3 illumination = shade(textbook, material, &hit, v, &reaching);
        total = add(total, scale(weight, illumination));
        record_shaded(textbook->recorder, illumination, weight, total, reaching);
        Real reflection = (Real)material->reflection;
        if (reaching == 0 && shading->shadow == SHADOW_BLACK)
            return end_path(textbook->recorder, PATH_IN_SHADOW, total, bounces);
        if (reflection == 0)
            return end_path(textbook->recorder, PATH_NOT_MIRROR, total, bounces);
        if (bounces == shading->max_bounces)
            return end_path(textbook->recorder, PATH_MAX_BOUNCES, total, bounces);
        ray = mirrored_ray(r, &hit);
        weight *= reflection;
        textbook->report->rays.reflection++;
        record_reflected(textbook->recorder, r, ray, reflection, weight, bounces + 1);
    }
}

/* 10. Clamped to [0, 1], as a byte. */
static unsigned char to_byte(Real c)
{
    c = c < 0 ? 0 : c > 1 ? 1 : c;
    return (unsigned char)floor(255 * c + (Real)0.5);
}

/* 10. The average of the pixel's samples. */
Vec3 textbook_pixel(const Textbook *textbook, int column, int row, unsigned char rgb[3])
{
    int grid = textbook->scene->grid;
    Real3 sum = {0, 0, 0};
    for (int j = 0; j < grid; j++)
        for (int i = 0; i < grid; i++)
            sum = add(sum, trace_path(textbook, primary_ray(textbook, column, row, i, j)));
    textbook->report->rays.primary += (uint64_t)(grid * grid);
    Real3 average = divide(sum, (Real)(grid * grid));
    rgb[0] = to_byte(average.x);
    rgb[1] = to_byte(average.y);
    rgb[2] = to_byte(average.z);
    record_pixel(textbook->recorder, grid * grid, sum, average, rgb);
    return doubles(average);
}

TextbookTest textbook_test(const Textbook *textbook, int face, Ray ray)
{
    Hit hit = {.face = face};
    RealRay rounded_ray = {rounded(ray.origin), rounded(ray.direction)};
    bool found = hits(textbook->scene, face, &rounded_ray, &hit);
    if (found)
        place_hit(textbook, &hit);
    return (TextbookTest){found, test_of(&hit, found), doubles(hit.p), doubles(hit.shifted)};
}
