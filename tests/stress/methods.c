/* The four ways to trace, behind one set of questions. */
#include "opencl/opencl_cast.h"
#include "scenes.h"
#include "suite.h"
#include "trace/reference.h"
#include "trace/textbook.h"

#include <float.h>
#include <stdio.h>
#include <stdlib.h>

/* More faces than this are asked through a tree, by the product's own casting. */
enum { FEW_FACES = 256 };

bool method_is_float(Method method)
{
    return method == TEXTBOOK || method == KERNEL_FLOAT;
}

const char *method_name(Method method)
{
    static const char *const names[METHOD_COUNT] = {"textbook float", "kernel float", "kernel double", "reference"};
    return names[method];
}

double method_ulp(Method method, double x)
{
    int exponent;
    frexp(x, &exponent);
    return ldexp(1, exponent - (method_is_float(method) ? FLT_MANT_DIG : DBL_MANT_DIG));
}

void method_round(Method method, double *numbers, long count)
{
    if (method == TEXTBOOK)
        for (long i = 0; i < count; i++)
            numbers[i] = (double)(float)numbers[i];
}

bool method_is_here(const Suite *suite, Method method)
{
    return method != KERNEL_DOUBLE || suite->probes[1].session.context;
}

void method_round_to_device(const Suite *suite, double *numbers, long count)
{
    for (long i = 0; i < count && !method_is_here(suite, KERNEL_DOUBLE); i++) {
        float high = (float)numbers[i];
        numbers[i] = (double)high + (double)(float)(numbers[i] - (double)high);
    }
}

static Ray ray_at(const double *numbers)
{
    return (Ray){vec3_at(numbers), vec3_at(numbers + 3)};
}

static Probe *probe_of(Suite *suite, Method method)
{
    return &suite->probes[method == KERNEL_DOUBLE];
}

void suite_load(Suite *suite, const Scene *scene)
{
    Error error = {0};
    accel_free(&suite->accel);
    suite->scene = scene;
    stop_unless(accel_build(&suite->accel, scene, ACCEL_AUTO, 0, &error), &error);
    probe_load(&suite->probes[0], scene);
    if (method_is_here(suite, KERNEL_DOUBLE))
        probe_load(&suite->probes[1], scene);
}

static void nearest_by_tree(const Suite *suite, Method method, const double *rays, long count, CastHit *hits)
{
    RenderSettings settings = {.precision = method == KERNEL_FLOAT ? PRECISION_FLOAT : PRECISION_DOUBLE, .device = -1};
    RenderReport report;
    Error error = {0};
    stop_unless(opencl_cast(suite->scene, &settings, rays, count, hits, &report, &error), &error);
}

static CastHit nearest_by_textbook(const Scene *scene, Ray ray)
{
    const Textbook textbook = {.scene = scene};
    CastHit nearest = {-1, HUGE_VAL};
    for (int i = 0; i < scene->face_count; i++) {
        TextbookTest face = textbook_test_float(&textbook, i, ray);
        if (face.hit && face.test.t < nearest.t)
            nearest = (CastHit){i, face.test.t};
    }
    return nearest;
}

void method_nearest(Suite *suite, Method method, const double *rays, long count, CastHit *hits)
{
    RenderReport report = {0};
    const Tracer tracer = {.scene = suite->scene, .accel = &suite->accel, .report = &report};
    if (method == TEXTBOOK)
        for (long i = 0; i < count; i++)
            hits[i] = nearest_by_textbook(suite->scene, ray_at(rays + 6 * i));
    else if (method == REFERENCE)
        for (long i = 0; i < count; i++)
            hits[i] = reference_nearest(&tracer, ray_at(rays + 6 * i), -1);
    else if (suite->scene->face_count <= FEW_FACES)
        probe_nearest(probe_of(suite, method), rays, count, hits);
    else
        nearest_by_tree(suite, method, rays, count, hits);
}

static int count_by_reference(const Scene *scene, Ray ray)
{
    int count = 0;
    for (int i = 0; i < scene->face_count; i++)
        count += face_test(&scene->faces[i], &scene->planes[i], ray, HUGE_VAL, false).verdict == FACE_INSIDE;
    return count;
}

static int count_by_textbook(const Scene *scene, Ray ray)
{
    const Textbook textbook = {.scene = scene};
    int count = 0;
    for (int i = 0; i < scene->face_count; i++)
        count += textbook_test_float(&textbook, i, ray).hit;
    return count;
}

void method_counts(Suite *suite, Method method, const double *rays, long count, CastHit *hits)
{
    int *counts = malloc((size_t)count * sizeof *counts);
    if (method == TEXTBOOK)
        for (long i = 0; i < count; i++)
            counts[i] = count_by_textbook(suite->scene, ray_at(rays + 6 * i));
    else if (method == REFERENCE)
        for (long i = 0; i < count; i++)
            counts[i] = count_by_reference(suite->scene, ray_at(rays + 6 * i));
    else
        probe_counts(probe_of(suite, method), rays, count, counts);
    for (long i = 0; i < count; i++)
        hits[i] = (CastHit){counts[i], 0};
    free(counts);
}

static bool blocked_by_reference(const Scene *scene, const double *segment, int left)
{
    for (int i = 0; i < scene->face_count; i++)
        if (i != left &&
            face_test_segment(&scene->faces[i], &scene->planes[i], vec3_at(segment), vec3_at(segment + 3), false)
                    .verdict == FACE_INSIDE)
            return true;
    return false;
}

/* The way to the light, too, is rounded to float. */
static bool blocked_by_textbook(const Scene *scene, const double *segment, int left)
{
    const Textbook textbook = {.scene = scene};
    double way[3];
    for (int i = 0; i < 3; i++)
        way[i] = (double)((float)segment[3 + i] - (float)segment[i]);
    for (int i = 0; i < scene->face_count; i++) {
        TextbookTest face = textbook_test_float(&textbook, i, (Ray){vec3_at(segment), vec3_at(way)});
        if (i != left && face.hit && face.test.t < 1)
            return true;
    }
    return false;
}

void method_blocked(Suite *suite, Method method, const double *segments, const int *left, long count, int *blocked)
{
    if (method == TEXTBOOK)
        for (long i = 0; i < count; i++)
            blocked[i] = blocked_by_textbook(suite->scene, segments + 6 * i, left[i]);
    else if (method == REFERENCE)
        for (long i = 0; i < count; i++)
            blocked[i] = blocked_by_reference(suite->scene, segments + 6 * i, left[i]);
    else
        probe_blocked(probe_of(suite, method), segments, left, count, blocked);
}

/* As place_hit in reference.c. */
static void points_by_reference(const Scene *scene, Ray ray, CastHit hit, double *point, double *shifted)
{
    const Plane *plane = &scene->planes[hit.face];
    Vec3 p = vec3_add(ray.origin, vec3_scale(hit.t, ray.direction));
    bool front = plane_side(&scene->faces[hit.face], plane, ray.origin) > 0;
    vec3_put(point, p);
    vec3_put(shifted,
             point_shifted(&scene->faces[hit.face], plane, front ? plane->normal : vec3_negate(plane->normal), p));
}

static void points_by_textbook(const Scene *scene, Ray ray, CastHit hit, double *point, double *shifted)
{
    const Textbook textbook = {.scene = scene, .shift = SCENE_SHIFT};
    TextbookTest face = textbook_test_float(&textbook, hit.face, ray);
    vec3_put(point, face.point);
    vec3_put(shifted, face.shifted);
}

void method_points(Suite *suite, Method method, const double *rays, long count, CastHit *hits, double *points,
                   double *shifted)
{
    if (method == KERNEL_FLOAT || method == KERNEL_DOUBLE) {
        probe_points(probe_of(suite, method), rays, count, hits, points, shifted);
        return;
    }
    method_nearest(suite, method, rays, count, hits);
    for (long i = 0; i < count; i++) {
        if (hits[i].face < 0)
            continue;
        if (method == TEXTBOOK)
            points_by_textbook(suite->scene, ray_at(rays + 6 * i), hits[i], points + 3 * i, shifted + 3 * i);
        else
            points_by_reference(suite->scene, ray_at(rays + 6 * i), hits[i], points + 3 * i, shifted + 3 * i);
    }
}
