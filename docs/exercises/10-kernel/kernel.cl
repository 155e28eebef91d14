/* Exercise 10: a picture by OpenCL. The README beside this file tells the task. Seven functions are empty: fill in
 * their bodies, in this order. Each comment is a contract. The rest is the plain kernel of the program as it stands.
 *
 * What you may use, all of it short, in kernels/plain/scene.cl and kernels/plain/textbook_arithmetic.cl:
 *     wide, wide3                   a number, and three of them with .x, .y and .z: points and directions
 *     real, real3                   the same, perhaps of fewer digits: colours
 *     a + b, a - b, s * a, -a       of vectors, part by part; a * b multiplies colours part by part
 *     vec3_dot(a, b)                a.b
 *     unit_or_zero(a)               a / |a|
 *     vload3(0, row + PLACE)        the three numbers that stand at PLACE in a row, as a real3
 *     row[PLACE]                    the number there
 *     Ray, Hit, Scene               structs: plain/scene.cl lists what is in them
 *     face_normal(scene, face)      N of the face
 *     face_material(scene, face)    the row of its material: MATERIAL_AMBIENT, ..._DIFFUSE, ..._SPECULAR,
 *                                   ..._EXPONENT (alpha/4) and ..._REFLECTION
 *     face_test(scene, face, ray, &hit)           does the ray hit the face? Fills hit.face, hit.t and hit.from_behind
 *     face_blocks(scene, face, ray, light)        is the face between the ray's origin and the light?
 *     point_shifted(scene, hit)                   hit->point, moved off the face along hit->normal
 * Which faces are to be tested, the tree tells:
 *     Traversal way; int first, count;
 *     begin_traversal(scene, ray, &way);                          once for a ray, then again and again:
 *     next_leaf(scene, ray, limit, &way, &first, &count)          false: no faces are left before t = limit; true: test
 *     face_in_leaf(scene, i)                                      the faces of each i from first to first + count - 1
 */
#include "shared/layout.h"
#include "shared/precision.cl"
#include "plain/scene.cl"
#include ARITHMETIC
#include PLAIN_TREE

/* Function 1. The ray from the camera through the middle of sub-pixel (i, j) of a pixel. The pixel has
 * p->grid x p->grid of them, the picture has p->columns x p->rows pixels, row 0 at the top.
 * Its origin is `eye`. Its direction is R = Q - C = forward + x right + y up, where x and y are those of the sample on
 * the screen, from its middle. It leaves no face: -1. */
static Ray primary_ray(const Scene *scene, int column, int row, int i, int j)
{
    constant const Parameters *p = scene->parameters;
    global const real *view = scene->view;
    wide3 eye = vector_at(view + VIEW_EYE, VIEW_REALS), forward = vector_at(view + VIEW_FORWARD, VIEW_REALS);
    wide3 right = vector_at(view + VIEW_RIGHT, VIEW_REALS), up = vector_at(view + VIEW_UP, VIEW_REALS);
    wide3 size = vector_at(view + VIEW_WIDTH, VIEW_REALS); /* size.x is the screen's width, size.y its height */
    /* Your lines. */
    return (Ray){(wide3)0, (wide3)0, 0};
}

/* Step 5: the smaller t; of equal ones, the first in the file. */
static bool is_nearer(const Scene *scene, const Hit *hit, const Hit *nearest)
{
    if (hit->t_in_box == nearest->t_in_box && nearest->face >= 0)
        return scene->faces[hit->face].index < scene->faces[nearest->face].index;
    return hit->t_in_box < nearest->t_in_box;
}

/* Function 2. The nearest face that the ray hits, as is_nearer tells; with .face = -1 if there is none. What lies
 * beyond t = nearest.t_in_box is not worth a search. */
static Hit nearest_hit(Scene *scene, Ray ray)
{
    Hit nearest = {.face = -1, .t_in_box = INFINITY}, hit;
    /* Your lines. */
    return nearest;
}

/* Function 3. Fills the rest of a hit: hit->point, which is O + t R; hit->normal, which is N, or -N where the ray came
 * from behind; and, from both, hit->shifted. */
static void place_hit(const Scene *scene, Ray ray, Hit *hit)
{
    /* Your lines. */
}

/* Function 4. Is any face between the shifted point of the hit and the light? The ray starts at the one, t = 0, and
 * comes to the other at t = 1. It leaves the face hit->face. The first face that blocks is enough. */
static bool is_blocked(Scene *scene, const Hit *hit, wide3 light)
{
    scene->counts[COUNT_SHADOW]++;
    /* Your lines. */
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

/* Function 5. ka ia + kd id (L.N) + ks is (N.H)^(alpha/4), where H = unit(L + V), and a negative cosine counts as 0.
 * Where the light does not reach the point, ka ia is all. n, l and v are unit vectors: the normal, to the light, to
 * the viewer. The light's colours stand at LIGHT_AMBIENT, LIGHT_DIFFUSE and LIGHT_SPECULAR of its row. pow(x, y) is x
 * to the power of y. */
static real3 illuminate(global const real *material, global const real *light, wide3 n, wide3 l, wide3 v, bool reaches)
{
    /* Your lines. */
    return (real3)0;
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

/* Function 6. The light that comes to the camera along the ray: the illumination of each hit, weighted by the product
 * of the reflections of the mirrors before it. Once around for each hit:
 * - No hit: the background, vload3(0, scene->view + VIEW_BACKGROUND), is seen, and that is all.
 * - v, to the viewer, is -R as a unit vector if p->viewer_ray, else the unit vector from the hit to `eye`.
 * - shade(scene, &hit, v, &reaching) is the illumination; `reaching` tells how many lights reach the hit.
 * - The path ends where no light reaches the hit, unless p->shadow_ambient; where the reflection is 0; and after
 *   p->max_bounces mirrors.
 * - Else the ray goes on from hit.shifted, mirrored: R - 2 (R.N) N with R as a unit vector. It leaves hit.face.
 *   Count it: scene->counts[COUNT_REFLECTION]++. */
static real3 trace_path(Scene *scene, Ray ray)
{
    constant const Parameters *p = scene->parameters;
    wide3 eye = ray.origin;
    real3 total = (real3)0;
    /* Your lines. */
    return total;
}

/* Function 7. Puts a colour into the picture as three bytes: each number cut to 0 .. 1, times 255, rounded.
 * clamp(x, low, high) cuts. With the option LINEAR the numbers are stored as they are, which the tests use. */
static void store_pixel(global uchar *picture, size_t place, real3 colour)
{
    real rgb[3] = {colour.x, colour.y, colour.z};
    for (int i = 0; i < 3; i++)
#ifdef LINEAR
        ((global real *)picture)[3 * place + i] = rgb[i];
#else
        picture[3 * place + i] = 0; /* Your line. */
#endif
}

/* Adds this work-item's counts to those of all. */
static void add_counts(volatile global uint *totals, const Scene *scene)
{
    for (int kind = 0; kind < COUNTER_KINDS; kind++)
        if (scene->counts[kind])
            atomic_add(totals + get_global_id(0) % COUNTER_STRIPES * COUNTER_STRIDE + kind, scene->counts[kind]);
}

/* A work-item is a pixel of the band that this launch renders. */
kernel void render(constant Parameters *parameters, global const FaceRecord *faces, global const real *face_rows,
                   global const wide *planes, global const real *materials, global const real *lights,
                   global const real *view, global uchar *picture, volatile global uint *totals,
                   global const float *tree_floats, global const int *tree_ints)
{
    Scene scene = {parameters, faces, face_rows, planes, materials, lights, view, tree_floats, tree_ints, {0}};
    int pixel = (int)get_global_id(0), grid = parameters->grid;
    int column = pixel % parameters->band_columns, row = pixel / parameters->band_columns;
    if (row >= parameters->band_rows)
        return; /* the last group may have more work-items than there are pixels */
    real3 sum = (real3)0;
    for (int j = 0; j < grid; j++)
        for (int i = 0; i < grid; i++)
            sum += trace_path(&scene, primary_ray(&scene, parameters->first_column + column,
                                                  parameters->first_row + row, i, j));
    store_pixel(picture, pixel, sum / (real)(grid * grid));
    scene.counts[COUNT_PRIMARY] = grid * grid;
    add_counts(totals, &scene);
}
