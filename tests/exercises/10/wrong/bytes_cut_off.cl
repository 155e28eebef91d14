/* Fails at store_pixel: the number is cut off, not rounded. */
/* The plain kernel: one ray per work-item, the steps of docs/algorithm.md in their order, with the names of
 * src/trace/reference.c. Read it first. The kernels in packet/ and tile/ do the same for many rays at once.
 * A work-item is one call of `render`, at the end. `global` and `constant` data lies in the memory of the device.
 * `real` and `wide` are float or double (shared/precision.cl), real3 and wide3 are three of them: x, y, z.
 * The host chooses two files: ARITHMETIC, how a ray is tested against a face (steps 3, 4 and 6), is
 * plain/exact_arithmetic.cl or plain/textbook_arithmetic.cl; PLAIN_TREE, which faces are tested, is plain/all_faces.cl,
 * plain/bvh.cl or plain/kdtree.cl. */
#include "shared/layout.h"
#include "shared/precision.cl"
#include "plain/scene.cl"
#include ARITHMETIC
#include PLAIN_TREE

/* Step 1: the ray from the camera through sub-pixel (i, j) of a pixel. */
static Ray primary_ray(const Scene *scene, int column, int row, int i, int j)
{
    constant const Parameters *p = scene->parameters;
    global const real *view = scene->view;
    wide3 eye = vector_at(view + VIEW_EYE, VIEW_REALS), forward = vector_at(view + VIEW_FORWARD, VIEW_REALS);
    wide3 right = vector_at(view + VIEW_RIGHT, VIEW_REALS), up = vector_at(view + VIEW_UP, VIEW_REALS);
    wide3 size = vector_at(view + VIEW_WIDTH, VIEW_REALS); /* width, height */
    wide x = ((column + (i + (wide)0.5f) / p->grid) / p->columns - (wide)0.5f) * size.x;
    wide y = ((wide)0.5f - (row + (j + (wide)0.5f) / p->grid) / p->rows) * size.y;
    return (Ray){eye, forward + x * right + y * up, -1};
}

/* Step 5: the smaller t; of equal ones, the first in the file. */
static bool is_nearer(const Scene *scene, const Hit *hit, const Hit *nearest)
{
    if (hit->t_in_box == nearest->t_in_box && nearest->face >= 0)
        return scene->faces[hit->face].index < scene->faces[nearest->face].index;
    return hit->t_in_box < nearest->t_in_box;
}

/* Steps 3 to 5. */
static Hit nearest_hit(Scene *scene, Ray ray)
{
    Hit nearest = {.face = -1, .t_in_box = INFINITY}, hit;
    Traversal way;
    int first, count;
    begin_traversal(scene, ray, &way);
    while (next_leaf(scene, ray, nearest.t_in_box, &way, &first, &count))
        for (int i = first; i < first + count; i++)
            if (face_test(scene, face_in_leaf(scene, i), ray, &hit) && is_nearer(scene, &hit, &nearest))
                nearest = hit;
    return nearest;
}

/* The point of the hit, the normal on the ray's side, and the point from which the next rays start. */
static void place_hit(const Scene *scene, Ray ray, Hit *hit)
{
    wide3 n = face_normal(scene, hit->face);
    hit->point = ray.origin + hit->t * ray.direction;
    hit->normal = hit->from_behind ? -n : n;
    hit->shifted = point_shifted(scene, hit);
}

/* Step 6: is any face between the shifted point and the light? */
static bool is_blocked(Scene *scene, const Hit *hit, wide3 light)
{
    Ray ray = {hit->shifted, light - hit->shifted, hit->face};
    Traversal way;
    int first, count;
    scene->counts[COUNT_SHADOW]++;
    begin_traversal(scene, ray, &way);
    while (next_leaf(scene, ray, 1, &way, &first, &count))
        for (int i = first; i < first + count; i++)
            if (face_blocks(scene, face_in_leaf(scene, i), ray, light))
                return true;
    return false;
}

/* Step 6. A light behind the face, or in its plane, leaves it in shadow. */
static bool light_reaches(Scene *scene, const Hit *hit, wide3 light)
{
    if (faces_light(scene, hit, light))
        return !is_blocked(scene, hit, light);
    scene->counts[COUNT_SKIPPED + SKIP_LIGHT_BEHIND]++;
    return false;
}

static real at_least_zero(wide x) { return x > 0 ? (real)x : 0; }

/* Step 7: Blinn-Phong with a quarter of the shininess. Unit vectors: n the normal, l to the light, v to the viewer. */
static real3 illuminate(global const real *material, global const real *light, wide3 n, wide3 l, wide3 v, bool reaches)
{
    real3 ambient = vload3(0, material + MATERIAL_AMBIENT) * vload3(0, light + LIGHT_AMBIENT);
    real3 diffuse = vload3(0, material + MATERIAL_DIFFUSE) * vload3(0, light + LIGHT_DIFFUSE);
    real3 specular = vload3(0, material + MATERIAL_SPECULAR) * vload3(0, light + LIGHT_SPECULAR);
    wide3 h = unit_or_zero(l + v);
    real l_dot_n = at_least_zero(vec3_dot(l, n)), n_dot_h = at_least_zero(vec3_dot(n, h));
    if (!reaches)
        return ambient;
    return ambient + l_dot_n * diffuse + pow(n_dot_h, material[MATERIAL_EXPONENT]) * specular;
}

/* Steps 6 to 8: the light that the point sends to the viewer. *reaching counts the lights that reach it. */
static real3 shade(Scene *scene, const Hit *hit, wide3 v, int *reaching)
{
    real3 colour = (real3)0;
    *reaching = 0;
    for (int i = 0; i < scene->parameters->light_count; i++) {
        global const real *light = scene->lights + i * LIGHT_REALS;
        wide3 position = vector_at(light + LIGHT_POSITION, LIGHT_POSITION_LOW - LIGHT_POSITION);
        bool reaches = light_reaches(scene, hit, position);
        *reaching += reaches;
        if (!reaches && !scene->parameters->shadow_ambient)
            continue; /* step 8: black */
        wide3 l = unit_or_zero(position - hit->point);
        colour += illuminate(face_material(scene, hit->face), light, hit->normal, l, v, reaches);
    }
    return colour;
}

/* Steps 3 to 9: the sum of the hits' illuminations, each weighted by the mirrors before it. */
static real3 trace_path(Scene *scene, Ray ray)
{
    constant const Parameters *p = scene->parameters;
    wide3 eye = ray.origin;
    real3 total = (real3)0;
    real weight = 1;
    for (int bounces = 0;; bounces++) {
        Hit hit = nearest_hit(scene, ray);
        if (hit.face < 0)
            return total + weight * vload3(0, scene->view + VIEW_BACKGROUND);
        place_hit(scene, ray, &hit);
        wide3 r = unit_or_zero(ray.direction), v = p->viewer_ray ? -r : unit_or_zero(eye - hit.point);
        int reaching;
        total += weight * shade(scene, &hit, v, &reaching);
        real reflection = face_material(scene, hit.face)[MATERIAL_REFLECTION];
        if ((reaching == 0 && !p->shadow_ambient) || reflection == 0 || bounces == p->max_bounces)
            return total;
        ray = (Ray){hit.shifted, r - 2 * vec3_dot(r, hit.normal) * hit.normal, hit.face}; /* mirrored */
        weight *= reflection;
        scene->counts[COUNT_REFLECTION]++;
    }
}

/* Step 10: puts the colour into the picture as three bytes; with the build option LINEAR, as three numbers. */
static void store_pixel(global uchar *picture, size_t place, real3 colour)
{
    real rgb[3] = {colour.x, colour.y, colour.z};
    for (int i = 0; i < 3; i++)
#ifdef LINEAR
        ((global real *)picture)[3 * place + i] = rgb[i];
#else
        picture[3 * place + i] = (uchar)(255 * clamp(rgb[i], (real)0, (real)1));
#endif
}

/* Adds this work-item's counts to those of all. */
static void add_counts(volatile global uint *totals, const Scene *scene)
{
    for (int kind = 0; kind < COUNTER_KINDS; kind++)
        if (scene->counts[kind])
            atomic_add(totals + get_global_id(0) % COUNTER_STRIPES * COUNTER_STRIDE + kind, scene->counts[kind]);
}

/* A work-item is a pixel of the band of rows that this launch renders. */
kernel void render(constant Parameters *parameters, global const FaceRecord *faces, global const real *face_rows,
                   global const wide *planes, global const real *materials, global const real *lights,
                   global const real *view, global uchar *picture, volatile global uint *totals,
                   global const float *tree_floats, global const int *tree_ints)
{
    Scene scene = {parameters, faces, face_rows, planes, materials, lights, view, tree_floats, tree_ints, {0}};
    int pixel = (int)get_global_id(0), grid = parameters->grid;
    int column = pixel % parameters->columns, row = pixel / parameters->columns;
    if (row >= parameters->band_rows)
        return; /* the last group may have more work-items than there are pixels */
    real3 sum = (real3)0;
    for (int j = 0; j < grid; j++)
        for (int i = 0; i < grid; i++)
            sum += trace_path(&scene, primary_ray(&scene, column, parameters->first_row + row, i, j));
    store_pixel(picture, pixel, sum / (real)(grid * grid));
    scene.counts[COUNT_PRIMARY] = grid * grid;
    add_counts(totals, &scene);
}
