/* Faces are sorted by their planes, and those in one plane are held against one another. */
#include "scene/hints_plane.h"

#include "scene/geometry.h"
#include "scene/solid.h"

#include <stdint.h>
#include <stdlib.h>

/* No more pairs than this are looked at: a hint is not worth more time. */
enum { PAIRS_MOST = 1 << 22 };

/* A plane in steps that are larger than rounding, mixed into one number. */
typedef struct PlaneKey {
    uint64_t plane;
    int face;
} PlaneKey;

static double scene_reach(const Scene *scene)
{
    double reach = 1e-30;
    for (int i = 0; i < scene->face_count; i++)
        for (int k = 0; k < scene->faces[i].vertex_count; k++)
            reach = fmax(reach, vec3_largest(face_vertex(&scene->faces[i], k)));
    return reach;
}

/* The normal is turned to one side, so that it does not matter which way round a face is listed. */
static PlaneKey key_of(const Scene *scene, int face, double reach)
{
    Vec3 n = scene->planes[face].normal;
    double largest = vec3_largest(n), sign = 1;
    for (int axis = 2; axis >= 0; axis--)
        if (fabs(vec3_component(n, axis)) > 0.999 * largest)
            sign = vec3_component(n, axis) < 0 ? -1 : 1;
    const double parts[4] = {n.x, n.y, n.z, scene->planes[face].d / reach};
    PlaneKey key = {.face = face};
    for (int i = 0; i < 4; i++) /* 2^64 by the golden ratio, as in Fibonacci hashing (Knuth, volume 3, section 6.4) */
        key.plane = (key.plane ^ (key.plane >> 29) ^ (uint64_t)llround(1e5 * sign * parts[i])) * 0x9E3779B97F4A7C15;
    return key;
}

static int compare_keys(const void *a, const void *b)
{
    const PlaneKey *x = a, *y = b;
    if (x->plane != y->plane)
        return x->plane < y->plane ? -1 : 1;
    return (x->face > y->face) - (x->face < y->face);
}

/* Does one of the edges of `face` have all of `other` on its outer side, but for a small part of it? */
static bool is_apart_by_edge(const Face *face, Vec3 normal, const Face *other, double margin)
{
    for (int k = 0; k < face->vertex_count; k++) {
        Vec3 a = face_vertex(face, k), edge = vec3_sub(face_vertex(face, (k + 1) % face->vertex_count), a);
        Vec3 inward = vec3_unit(vec3_cross(normal, edge));
        int outside = 0;
        for (int i = 0; i < other->vertex_count; i++)
            outside += vec3_dot(inward, vec3_sub(face_vertex(other, i), a)) <= margin;
        if (outside == other->vertex_count)
            return true;
    }
    return false;
}

static bool is_seen(Solids *solids, int index)
{
    const Scene *scene = solids->scene;
    const Face *face = &scene->faces[index];
    if (face->one_sided)
        return plane_side(face, &scene->planes[index], scene->camera.position) > 0;
    return !solid_hides(solids, index);
}

static bool overlap(Solids *solids, int a, int b)
{
    const Scene *scene = solids->scene;
    const Face *first = &scene->faces[a], *second = &scene->faces[b];
    const Plane *p = &scene->planes[a], *q = &scene->planes[b];
    if (first->number == second->number || first->material == second->material)
        return false;
    double margin = 1e-3 * sqrt(fmin(p->length, q->length));
    return !is_apart_by_edge(first, p->normal, second, margin) && !is_apart_by_edge(second, q->normal, first, margin) &&
           is_seen(solids, a) && is_seen(solids, b);
}

/* The first pair among faces sorted by their planes, and how many there are. */
static Hint find_pairs(Solids *solids, const PlaneKey *keys, int count)
{
    Hint hint = {HINT_SAME_PLANE, count, count, 0};
    int pairs = 0;
    for (int i = 0; i < count; i++)
        for (int k = i + 1; k < count && pairs < PAIRS_MOST && keys[i].plane == keys[k].plane; k++, pairs++)
            if (overlap(solids, keys[i].face, keys[k].face)) {
                bool earlier = keys[i].face < hint.first || (keys[i].face == hint.first && keys[k].face < hint.second);
                hint.first = earlier ? keys[i].face : hint.first;
                hint.second = earlier ? keys[k].face : hint.second;
                hint.count++;
            }
    return hint;
}

bool hints_find_planes(Hints *hints, const Scene *scene, Error *error)
{
    Solids solids = {0};
    int count = scene->material_count > 1 ? scene->face_count : 0;
    Hint hint = {0};
    PlaneKey *keys = malloc((size_t)count * sizeof *keys + 1);
    bool good = keys ? solids_make(&solids, scene, error) : error_memory(error, "the planes of the scene");
    if (good) {
        double reach = scene_reach(scene);
        for (int i = 0; i < count; i++)
            keys[i] = key_of(scene, i, reach);
        qsort(keys, (size_t)count, sizeof *keys, compare_keys);
        hint = find_pairs(&solids, keys, count);
        good = error->kind == ERROR_NONE;
    }
    solids_free(&solids);
    free(keys);
    return good && (hint.count == 0 || hint_add(hints, hint, error));
}
