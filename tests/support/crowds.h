/* Scenes of many random faces, each kind hard on a tree in its own way, and rays that are hard on those faces.
 * A crowd owns its faces: free it. To add a kind: a name, a line in crowd_face. */
#ifndef RECTRAY_TESTS_CROWDS_H
#define RECTRAY_TESTS_CROWDS_H

#include "small_scene.h"
#include "xorshift.h"

#include "unity.h"

#include <math.h>
#include <stdlib.h>

typedef enum Crowd {
    CROWD_BOXES,  /* axis-parallel boxes, some of which share sides */
    CROWD_QUADS,  /* quads turned all ways, rounded to floats and so a little warped */
    CROWD_WARPED, /* the same, as far from flat as a scene may be */
    CROWD_TILTED, /* nearly axis-parallel: boxes thinner than a float's digits let them be told apart */
    CROWD_TILES,  /* a floor: coplanar squares, edge to edge */
    CROWD_SHEETS, /* floors above one another */
    CROWD_EQUAL,  /* the same face again and again */
    CROWD_KINDS
} Crowd;

static inline Vec3 random_point(uint64_t *state, double size)
{
    double x = random_unit(state), y = random_unit(state), z = random_unit(state);
    return vec3(size * x, size * y, size * z);
}

/* Side `side` (0..5) of the box between two corners. */
static inline Face box_side(Vec3 a, Vec3 b, int side)
{
    switch (side) {
    case 0:
        return face_quad(vec3(a.x, a.y, a.z), vec3(a.x, a.y, b.z), vec3(a.x, b.y, b.z), vec3(a.x, b.y, a.z));
    case 1:
        return face_quad(vec3(b.x, a.y, a.z), vec3(b.x, b.y, a.z), vec3(b.x, b.y, b.z), vec3(b.x, a.y, b.z));
    case 2:
        return face_quad(vec3(a.x, a.y, a.z), vec3(b.x, a.y, a.z), vec3(b.x, a.y, b.z), vec3(a.x, a.y, b.z));
    case 3:
        return face_quad(vec3(a.x, b.y, a.z), vec3(a.x, b.y, b.z), vec3(b.x, b.y, b.z), vec3(b.x, b.y, a.z));
    case 4:
        return face_quad(vec3(a.x, a.y, a.z), vec3(a.x, b.y, a.z), vec3(b.x, b.y, a.z), vec3(b.x, a.y, a.z));
    default:
        return face_quad(vec3(a.x, a.y, b.z), vec3(b.x, a.y, b.z), vec3(b.x, b.y, b.z), vec3(a.x, b.y, b.z));
    }
}

/* A parallelogram around `middle` with half its diagonals u and v; its ends on v are raised by `warp`. */
static inline Face parallelogram(Vec3 middle, Vec3 u, Vec3 v, double warp)
{
    Vec3 lift = vec3_scale(warp, vec3_unit(vec3_cross(u, v)));
    return face_quad(vec3_sub(middle, u), vec3_add(vec3_sub(middle, v), lift), vec3_add(middle, u),
                     vec3_add(vec3_add(middle, v), lift));
}

/* Side i % 6 of box i / 6, whose corners are whole numbers, so that boxes often touch. */
static inline Face crowd_box_side(int i)
{
    uint64_t box = 0x9e3779b97f4a7c15u * (uint64_t)(i / 6 + 1); /* random numbers of its own */
    random_next(&box);
    Vec3 low = vec3((double)random_integer(&box, 6), (double)random_integer(&box, 6), (double)random_integer(&box, 6));
    Vec3 size = vec3(1 + (double)(random_next(&box) % 3), 1 + (double)(random_next(&box) % 3),
                     1 + (double)(random_next(&box) % 3));
    return box_side(low, vec3_add(low, size), i % 6);
}

static inline Face crowd_face(Crowd kind, uint64_t *state, int i)
{
    Vec3 middle = random_point(state, 6), u = random_point(state, 1), v = random_point(state, 1);
    double across = random_unit(state) / 4096;
    Vec3 tile = vec3(i % 16 - 8, i / 16 % 16 - 8, kind == CROWD_SHEETS ? i / 256 : 0);
    u = vec3_dot(u, u) > 0 ? u : vec3(1, 0, 0);
    v = vec3_length(vec3_cross(u, v)) > 0.01 ? v : vec3_cross(u, vec3(u.z, u.x, -u.y));
    switch (kind) {
    case CROWD_BOXES:
        return crowd_box_side(i);
    case CROWD_QUADS:
        return parallelogram(middle, u, v, 0);
    case CROWD_WARPED:
        return parallelogram(middle, u, v, 1e-5 * vec3_length(u));
    case CROWD_TILTED:
        return parallelogram(middle, vec3(2, across * across, 1), vec3(across * across, across, 1), 0);
    case CROWD_EQUAL:
        return face_at_height(-1, -1, 1, 1, 0.25);
    default:
        return face_at_height(tile.x, tile.y, tile.x + 1, tile.y + 1, tile.z);
    }
}

static inline Scene crowd_scene(Crowd kind, int count, uint64_t seed)
{
    Scene scene = {
        .camera = {.position = {9, 12, 14}, .look_at = {0, 0, 0}, .up = {0, 1, 0}},
        .screen = {.columns = 48, .rows = 32, .distance = 1, .width = 1.5},
        .shading = {.max_bounces = 3, .shadow = SHADOW_AMBIENT},
        .grid = 1,
        .face_count = count,
        .faces = malloc((size_t)count * sizeof *scene.faces),
        .planes = malloc((size_t)count * sizeof *scene.planes),
        .lights = calloc(1, sizeof *scene.lights),
        .light_count = 1,
        .materials = calloc(1, sizeof *scene.materials),
        .material_count = 1,
    };
    TEST_ASSERT_TRUE(scene.faces && scene.planes && scene.lights && scene.materials);
    scene.lights[0] = (Light){{5, 14, 9}, {1, 1, 1}, {1, 1, 1}, {1, 1, 1}};
    scene.materials[0] = (Material){.ambient = {0.1, 0.1, 0.1}, .diffuse = {0.6, 0.5, 0.4}, .reflection = 0.5};
    for (int i = 0; i < count; i++) {
        scene.faces[i] = crowd_face(kind, &seed, i);
        scene.faces[i].number = i;
        scene.planes[i] = face_plane(&scene.faces[i]);
    }
    return scene;
}

/* A point of the face, often one of its vertices or on one of its edges. */
static inline Vec3 point_of_face(const Face *face, uint64_t *state)
{
    static const double steps[] = {0, 0, 0.5, 1, 1, 0.3};
    double s = steps[random_next(state) % 6], t = steps[random_next(state) % 6];
    Vec3 a = face_vertex(face, 0), b = face_vertex(face, 1), c = face_vertex(face, 2), d = face_vertex(face, 3);
    Vec3 low = vec3_add(vec3_scale(1 - s, a), vec3_scale(s, b)),
         high = vec3_add(vec3_scale(1 - s, d), vec3_scale(s, c));
    return vec3_add(vec3_scale(1 - t, low), vec3_scale(t, high));
}

/* Rays from anywhere to anywhere, to vertices and edges, along the axes in the planes of boxes' sides, and rays that
 * graze the plane of a face or lie in it. */
static inline Ray hard_ray(const Scene *scene, uint64_t *state)
{
    const Face *face = &scene->faces[random_next(state) % (uint64_t)scene->face_count];
    const Face *other = &scene->faces[random_next(state) % (uint64_t)scene->face_count];
    Vec3 target = point_of_face(face, state), from = random_point(state, 12), along = {0, 0, 0};
    switch (random_next(state) % 5) {
    case 0:
        return (Ray){from, random_point(state, 1)};
    case 1:
        return (Ray){from, vec3_sub(target, from)};
    case 2: /* along an axis, forwards or backwards */
        *(random_next(state) % 3 == 0 ? &along.x : random_next(state) % 2 == 0 ? &along.y : &along.z) = 1;
        along = vec3_scale(random_next(state) % 2 == 0 ? 0.75 : -3, along);
        return (Ray){vec3_sub(target, vec3_scale(random_next(state) % 2 == 0 ? 4 : 0.5, along)), along};
    case 3: /* from vertex to vertex */
        return (Ray){point_of_face(other, state), vec3_sub(target, point_of_face(other, state))};
    default: /* in the plane of the face, or a little off it */
        along = vec3_sub(point_of_face(face, state), target);
        from = vec3_add(vec3_sub(target, vec3_scale(3, along)),
                        random_point(state, ldexp(1, -(int)(random_next(state) % 50))));
        return (Ray){from, vec3_sub(target, from)};
    }
}

#endif
