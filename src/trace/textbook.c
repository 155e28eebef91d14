/* The textbook tracer, to be checked against docs/algorithm.md with a finger: the numbers in the comments are its
 * steps. All is computed in `Real`: double here, float where textbook_float.c compiles this file once more. That is why
 * it has vectors and a path loop of its own: those of reference.c are double, and tell a recorder what they do. */
#include "trace/textbook.h"

#include "scene/geometry.h"

#include <tgmath.h>

#ifdef TEXTBOOK_IN_FLOAT
typedef float Real;
#define textbook_pixel textbook_pixel_float
#define textbook_sample textbook_sample_float
#define textbook_hit textbook_hit_float
#define textbook_test textbook_test_float
#define textbook_points textbook_points_float
#else
typedef double Real;
#endif

typedef struct Real3 {
    Real x, y, z;
} Real3;

/* P(t) = o + t r. */
typedef struct RealRay {
    Real3 o, r;
} RealRay;

typedef struct Hit {
    int face; /* -1: none */
    Real t;
    Real3 p;       /* the point */
    Real3 n;       /* N turned to the side that the ray came from */
    Real3 shifted; /* P moved off the face along N */
} Hit;

/* --- Vectors: an operation, a line --- */
/* clang-format off */

static Real3 rounded(Vec3 a) { return (Real3){(Real)a.x, (Real)a.y, (Real)a.z}; }
static Vec3 doubles(Real3 a) { return (Vec3){(double)a.x, (double)a.y, (double)a.z}; }
static Real3 add(Real3 a, Real3 b) { return (Real3){a.x + b.x, a.y + b.y, a.z + b.z}; }
static Real3 subtract(Real3 a, Real3 b) { return (Real3){a.x - b.x, a.y - b.y, a.z - b.z}; }
static Real3 scale(Real s, Real3 a) { return (Real3){s * a.x, s * a.y, s * a.z}; }
static Real3 multiply(Real3 a, Real3 b) { return (Real3){a.x * b.x, a.y * b.y, a.z * b.z}; }
static Real dot(Real3 a, Real3 b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
static Real at_least_zero(Real x) { return x > 0 ? x : 0; }

/* clang-format on */

static Real3 cross(Real3 a, Real3 b)
{
    return (Real3){a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

/* a / |a|; zero stays zero. */
static Real3 unit(Real3 a)
{
    Real length = sqrt(dot(a, a));
    return length > 0 ? (Real3){a.x / length, a.y / length, a.z / length} : a;
}

/* --- The steps --- */

/* 1. The ray from the camera C through sub-pixel (i, j) of a pixel: R = Q - C. */
static RealRay primary_ray(const Scene *scene, int column, int row, int i, int j)
{
    View view = view_of(scene);
    Real n = (Real)view.grid, columns = (Real)view.columns, rows = (Real)view.rows, half = (Real)0.5;
    Real x = (((Real)column + ((Real)i + half) / n) / columns - half) * (Real)view.width;
    Real y = (half - ((Real)row + ((Real)j + half) / n) / rows) * (Real)view.height;
    Real3 r = add(add(rounded(view.forward), scale(x, rounded(view.right))), scale(y, rounded(view.up)));
    return (RealRay){rounded(view.eye), r};
}

static Real3 vertex(const Face *face, int k)
{
    const float *v = face->vertices[k % face->vertex_count];
    return (Real3){(Real)v[0], (Real)v[1], (Real)v[2]};
}

/* 3. t in the plane A x + B y + C z + D = 0, N = (A, B, C); N.R is not 0. */
static Real t_in_plane(const Face *face, Real3 n, RealRay ray)
{
    Real d = -dot(n, vertex(face, 0));
    return -(dot(n, ray.o) + d) / dot(n, ray.r);
}

/* 4. Inside edge k it is positive, outside negative. */
static Real side_of_edge(const Face *face, int k, Real3 n, Real3 p)
{
    Real3 e = subtract(vertex(face, k + 1), vertex(face, k)), c = subtract(p, vertex(face, k));
    return dot(n, cross(e, c));
}

/* 3 and 4. Does the ray hit the face? Fills the face, t and P. */
static bool hits(const Scene *scene, int index, RealRay ray, Hit *hit)
{
    const Face *face = &scene->faces[index];
    Real3 n = rounded(scene->planes[index].normal);
    Real n_dot_r = dot(n, ray.r);
    if (n_dot_r == 0)
        return false; /* parallel */
    Real t = t_in_plane(face, n, ray);
    if (!(t > 0))
        return false; /* behind the origin */
    if (face->one_sided && n_dot_r > 0)
        return false; /* a one-sided face, from behind */
    Real3 p = add(ray.o, scale(t, ray.r));
    for (int k = 0; k < face->vertex_count; k++)
        if (side_of_edge(face, k, n, p) < 0)
            return false; /* outside edge k */
    *hit = (Hit){.face = index, .t = t, .p = p};
    return true;
}

/* 5. The face with the smallest t; of equal ones, the first in the file. */
static Hit nearest_hit(const Textbook *textbook, RealRay ray)
{
    Hit nearest = {.face = -1, .t = (Real)HUGE_VAL}, hit;
    for (int i = 0; i < textbook->scene->face_count; i++)
        if (hits(textbook->scene, i, ray, &hit) && hit.t < nearest.t)
            nearest = hit;
    textbook->report->face_tests += (uint64_t)textbook->scene->face_count;
    return nearest;
}

/* 6. The normal on the ray's side, and P shifted off the face along it. */
static void place_hit(const Textbook *textbook, RealRay ray, Hit *hit)
{
    Real3 n = rounded(textbook->scene->planes[hit->face].normal);
    hit->n = dot(n, ray.r) > 0 ? scale(-1, n) : n;
    hit->shifted = add(hit->p, scale((Real)textbook->shift, hit->n));
}

static void tell_hit(const Textbook *textbook, RealRay ray, const Hit *hit)
{
    TextbookEvent event = {.kind = hit->face < 0 ? TEXTBOOK_MISS : TEXTBOOK_HIT,
                           .origin = doubles(ray.o),
                           .direction = doubles(ray.r),
                           .face = hit->face,
                           .t = (double)hit->t,
                           .point = doubles(hit->p),
                           .normal = doubles(hit->n),
                           .shifted = doubles(hit->shifted)};
    if (textbook->listener)
        textbook->listener->tell(textbook->listener->user, &event);
}

static void tell_light(const Textbook *textbook, RealRay ray, Real height, int blocker)
{
    TextbookEvent event = {.kind = TEXTBOOK_LIGHT,
                           .origin = doubles(ray.o),
                           .direction = doubles(ray.r),
                           .face = -1,
                           .height = (double)height,
                           .blocker = blocker};
    if (textbook->listener)
        textbook->listener->tell(textbook->listener->user, &event);
}

/* 6. A face between the ray's origin and the light, at 0 < t < 1; -1: none. */
static int face_between(const Textbook *textbook, RealRay ray)
{
    Hit between;
    textbook->report->rays.shadow++;
    for (int i = 0; i < textbook->scene->face_count; i++) {
        textbook->report->face_tests++;
        if (hits(textbook->scene, i, ray, &between) && between.t < 1)
            return i;
    }
    return -1;
}

/* 6. Does the light at that position reach the point, or is it behind the face, or a face between them? */
static bool light_reaches(const Textbook *textbook, const Hit *hit, Real3 position)
{
    RealRay ray = {hit->shifted, subtract(position, hit->shifted)};
    Real height = dot(hit->n, subtract(position, hit->p));
    if (!(height > 0)) {
        textbook->report->skipped[SKIP_LIGHT_BEHIND]++;
        tell_light(textbook, ray, height, -1);
        return false;
    }
    int blocker = face_between(textbook, ray);
    tell_light(textbook, ray, height, blocker);
    return blocker < 0;
}

/* 7. I = ka ia + kd id (L.N) + ks is (N.H)^(alpha/4), H = (L+V)/|L+V|; of a point in shadow the first term. */
static Real3 illuminate(const Material *material, const Light *light, Real3 n, Real3 l, Real3 v, bool reaches)
{
    Real3 ambient = multiply(rounded(material->ambient), rounded(light->ambient));
    Real3 diffuse = multiply(rounded(material->diffuse), rounded(light->diffuse));
    Real3 specular = multiply(rounded(material->specular), rounded(light->specular));
    Real l_dot_n = at_least_zero(dot(l, n)), n_dot_h = at_least_zero(dot(n, unit(add(l, v))));
    if (!reaches)
        return ambient;
    Real highlight = pow(n_dot_h, (Real)(material->shininess / 4));
    return add(add(ambient, scale(l_dot_n, diffuse)), scale(highlight, specular));
}

/* 6 to 8. The light that the point sends to the viewer. *reaching counts the lights that reach it. */
static Real3 shade(const Textbook *textbook, const Hit *hit, Real3 v, int *reaching)
{
    const Scene *scene = textbook->scene;
    const Material *material = &scene->materials[scene->faces[hit->face].material];
    Real3 colour = {0, 0, 0};
    *reaching = 0;
    for (int i = 0; i < scene->light_count; i++) {
        Real3 position = rounded(scene->lights[i].position);
        bool reaches = light_reaches(textbook, hit, position);
        *reaching += reaches;
        if (!reaches && scene->shading.shadow == SHADOW_BLACK)
            continue;
        Real3 l = unit(subtract(position, hit->p));
        colour = add(colour, illuminate(material, &scene->lights[i], hit->n, l, v, reaches));
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
        if (hit.face >= 0)
            place_hit(textbook, ray, &hit);
        tell_hit(textbook, ray, &hit);
        if (hit.face < 0)
            return add(total, scale(weight, rounded(shading->background)));
        Real3 r = unit(ray.r), v = shading->viewer == VIEWER_RAY ? scale(-1, r) : unit(subtract(eye, hit.p));
        int reaching;
        total = add(total, scale(weight, shade(textbook, &hit, v, &reaching)));
        Real reflection = (Real)scene->materials[scene->faces[hit.face].material].reflection;
        bool in_shadow = reaching == 0 && shading->shadow == SHADOW_BLACK;
        if (in_shadow || reflection == 0 || bounces == shading->max_bounces)
            return total;
        ray = (RealRay){hit.shifted, subtract(r, scale(2 * dot(r, hit.n), hit.n))};
        weight *= reflection;
        textbook->report->rays.reflection++;
    }
}

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
            sum = add(sum, trace_path(textbook, primary_ray(textbook->scene, column, row, i, j)));
    textbook->report->rays.primary += (uint64_t)(grid * grid);
    Real samples = (Real)(grid * grid);
    Real3 average = {sum.x / samples, sum.y / samples, sum.z / samples};
    rgb[0] = to_byte(average.x);
    rgb[1] = to_byte(average.y);
    rgb[2] = to_byte(average.z);
    return doubles(average);
}

/* --- Single steps --- */

Vec3 textbook_sample(const Textbook *textbook, int column, int row, int i, int j)
{
    return doubles(trace_path(textbook, primary_ray(textbook->scene, column, row, i, j)));
}

TextbookTest textbook_test(const Textbook *textbook, int face, Vec3 origin, Vec3 direction)
{
    const Face *tested = &textbook->scene->faces[face];
    Real3 n = rounded(textbook->scene->planes[face].normal);
    RealRay ray = {rounded(origin), rounded(direction)};
    Real n_dot_r = dot(n, ray.r), t = n_dot_r == 0 ? 0 : t_in_plane(tested, n, ray);
    TextbookTest test = {.n_dot_r = (double)n_dot_r, .t = (double)t};
    for (int k = 0; k < tested->vertex_count; k++)
        test.edge_value[k] = (double)side_of_edge(tested, k, n, add(ray.o, scale(t, ray.r)));
    return test;
}

double textbook_hit(const Textbook *textbook, int face, Vec3 origin, Vec3 direction)
{
    Hit hit;
    return hits(textbook->scene, face, (RealRay){rounded(origin), rounded(direction)}, &hit) ? (double)hit.t : 0;
}

void textbook_points(const Textbook *textbook, int face, Vec3 origin, Vec3 direction, double t, Vec3 *point,
                     Vec3 *shifted)
{
    RealRay ray = {rounded(origin), rounded(direction)};
    Hit hit = {.face = face, .t = (Real)t, .p = add(ray.o, scale((Real)t, ray.r))};
    place_hit(textbook, ray, &hit);
    *point = doubles(hit.p);
    *shifted = doubles(hit.shifted);
}
