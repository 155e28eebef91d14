/* The textbook tracer, to be checked against docs/algorithm.md with a finger: the numbers in the comments are its
 * steps. All is computed in `Real`, which is double here and float where textbook_float.c compiles this file once more.
 * Vectors are in textbook_real.h. Calls of `record_...` tell the walkthrough what happens. */
#include "trace/textbook.h"

#include "scene/geometry.h"
#include "trace/textbook_real.h"
#include "trace/textbook_record.h"

/* 1. The ray from the camera C through sub-pixel (i, j) of a pixel: R = Q - C. */
static RealRay primary_ray(const Textbook *textbook, int column, int row, int i, int j)
{
    View view = view_of(textbook->scene);
    Real n = (Real)view.grid, columns = (Real)view.columns, rows = (Real)view.rows, half = (Real)0.5;
    Real x = (((Real)column + ((Real)i + half) / n) / columns - half) * (Real)view.width;
    Real y = (half - ((Real)row + ((Real)j + half) / n) / rows) * (Real)view.height;
    Real3 r = add(add(rounded(view.forward), scale(x, rounded(view.right))), scale(y, rounded(view.up)));
    RealRay ray = {rounded(view.eye), r};
    record_sample(textbook->recorder, (Place){column, row, i, j}, x, y, ray);
    return ray;
}

/* 3 and 4. Does the ray hit the face? Fills what it finds on the way. The plane is A x + B y + C z + D = 0. */
static bool hits(const Scene *scene, int index, RealRay ray, Hit *hit)
{
    const Face *face = &scene->faces[index];
    Real3 n = rounded(scene->planes[index].normal); /* N = (A, B, C) */
    Real d = -dot(n, vertex(face, 0));
    hit->face = index;
    hit->edges = 0;
    hit->n_dot_r = dot(n, ray.r);
    hit->n_dot_o_plus_d = dot(n, ray.o) + d;
    if (hit->n_dot_r == 0)
        return false; /* parallel */
    hit->t = -hit->n_dot_o_plus_d / hit->n_dot_r;
    if (!(hit->t > 0))
        return false; /* behind the origin */
    if (face->one_sided && hit->n_dot_r > 0)
        return false; /* a one-sided face, from behind */
    hit->p = add(ray.o, scale(hit->t, ray.r));
    for (int k = 0; k < face->vertex_count; k++) {
        Real3 e = subtract(vertex(face, k + 1), vertex(face, k)), c = subtract(hit->p, vertex(face, k));
        hit->edge[k] = dot(n, cross(e, c));
        hit->edges = k + 1;
        if (hit->edge[k] < 0)
            return false; /* outside edge k */
    }
    return true;
}

/* 5. The face with the smallest t; of equal ones, the first in the file. */
static Hit nearest_hit(const Textbook *textbook, RealRay ray)
{
    Hit nearest = {.face = -1, .t = (Real)HUGE_VAL}, hit;
    for (int i = 0; i < textbook->scene->face_count; i++) {
        bool found = hits(textbook->scene, i, ray, &hit);
        record_face(textbook->recorder, &hit, found, nearest.t);
        if (found && hit.t < nearest.t)
            nearest = hit;
    }
    textbook->report->face_tests += (uint64_t)textbook->scene->face_count;
    return nearest;
}

/* 6. The normal on the ray's side, and P shifted off the face along it. */
static void place_hit(const Textbook *textbook, Hit *hit)
{
    Real3 n = rounded(textbook->scene->planes[hit->face].normal);
    hit->n = hit->n_dot_r > 0 ? scale(-1, n) : n;
    hit->shifted = add(hit->p, scale((Real)textbook->shift, hit->n));
}

/* 6. A face between the shifted point and the light, at 0 < t < 1; -1: none. */
static int face_between(const Textbook *textbook, const Hit *hit, Real3 light)
{
    RealRay ray = {hit->shifted, subtract(light, hit->shifted)};
    textbook->report->rays.shadow++;
    for (int i = 0; i < textbook->scene->face_count; i++) {
        Hit between;
        bool found = hits(textbook->scene, i, ray, &between);
        record_occluder(textbook->recorder, &between, found);
        textbook->report->face_tests++;
        if (found && between.t < 1)
            return i;
    }
    return -1;
}

/* 6. Does the light reach the point, or is it behind the face, or a face between them? */
static bool light_reaches(const Textbook *textbook, const Hit *hit, int index)
{
    Real3 light = rounded(textbook->scene->lights[index].position);
    Real height = dot(hit->n, subtract(light, hit->p));
    record_light(textbook->recorder, hit, index, light, height);
    bool in_front = height > 0;
    int blocker = in_front ? face_between(textbook, hit, light) : -1;
    LightVerdict verdict = !in_front ? LIGHT_BEHIND_FACE : blocker < 0 ? LIGHT_REACHES : LIGHT_BLOCKED;
    record_light_end(textbook->recorder, index, verdict, blocker);
    textbook->report->skipped[SKIP_LIGHT_BEHIND] += !in_front;
    return verdict == LIGHT_REACHES;
}

/* 7. The terms of I = ka ia + kd id (L.N) + ks is (N.H)^(alpha/4), where H = (L+V)/|L+V|. */
static Terms illumination_terms(const Material *material, const Light *light, Real3 n, Real3 l, Real3 v)
{
    Terms terms = {.l = l, .v = v, .h = unit(add(l, v))};
    terms.l_dot_n = at_least_zero(dot(l, n));
    terms.n_dot_h = at_least_zero(dot(n, terms.h));
    Real highlight = pow(terms.n_dot_h, (Real)(material->shininess / 4));
    terms.ambient = multiply(rounded(material->ambient), rounded(light->ambient));
    terms.diffuse = scale(terms.l_dot_n, multiply(rounded(material->diffuse), rounded(light->diffuse)));
    terms.specular = scale(highlight, multiply(rounded(material->specular), rounded(light->specular)));
    return terms;
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
        ray = (RealRay){hit.shifted, subtract(r, scale(2 * dot(r, hit.n), hit.n))};
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
    bool found = hits(textbook->scene, face, (RealRay){rounded(ray.origin), rounded(ray.direction)}, &hit);
    if (found)
        place_hit(textbook, &hit);
    return (TextbookTest){found, test_of(&hit, found), doubles(hit.p), doubles(hit.shifted)};
}
