/* Small scenes for the tests, built in memory without a file and therefore not re-centred: what a test writes is what
 * is traced. Begin a SmallScene, add to it, then trace `small.scene`; it owns nothing and needs no freeing. */
#ifndef RECTRAY_TESTS_SMALL_SCENE_H
#define RECTRAY_TESTS_SMALL_SCENE_H

#include "scene/geometry.h"
#include "scene/scene.h"

enum { SMALL_SCENE_MAX = 64 };

typedef struct SmallScene {
    Scene scene;
    Face faces[SMALL_SCENE_MAX];
    Plane planes[SMALL_SCENE_MAX];
    Material materials[SMALL_SCENE_MAX];
    Light lights[SMALL_SCENE_MAX];
} SmallScene;

/* A camera at (0, 0, 1) that looks down -z through one pixel of 2 x 2 units at z = 0. */
static inline void small_scene_begin(SmallScene *small)
{
    *small = (SmallScene){.scene = {
                              .camera = {.position = {0, 0, 1}, .look_at = {0, 0, 0}, .up = {0, 1, 0}},
                              .screen = {.columns = 1, .rows = 1, .distance = 1, .width = 2},
                              .shading = {.max_bounces = 5},
                              .grid = 1,
                          }};
    small->scene.faces = small->faces;
    small->scene.planes = small->planes;
    small->scene.materials = small->materials;
    small->scene.lights = small->lights;
}

static inline int small_scene_material(SmallScene *small, Material material)
{
    small->materials[small->scene.material_count] = material;
    return small->scene.material_count++;
}

/* White in all three colours. */
static inline Light *small_scene_light(SmallScene *small, Vec3 position)
{
    Light *light = &small->lights[small->scene.light_count++];
    *light = (Light){position, {1, 1, 1}, {1, 1, 1}, {1, 1, 1}};
    return light;
}

static inline void face_set_vertex(Face *face, int index, Vec3 v)
{
    face->vertices[index][0] = (float)v.x;
    face->vertices[index][1] = (float)v.y;
    face->vertices[index][2] = (float)v.z;
}

static inline Face face_quad(Vec3 a, Vec3 b, Vec3 c, Vec3 d)
{
    Face face = {.vertex_count = 4};
    face_set_vertex(&face, 0, a);
    face_set_vertex(&face, 1, b);
    face_set_vertex(&face, 2, c);
    face_set_vertex(&face, 3, d);
    return face;
}

static inline Face face_triangle(Vec3 a, Vec3 b, Vec3 c)
{
    Face face = face_quad(a, b, c, a);
    face.vertex_count = 3;
    return face;
}

/* Axis-parallel, at the height z, its normal +z. */
static inline Face face_at_height(double x0, double y0, double x1, double y1, double z)
{
    return face_quad(vec3(x0, y0, z), vec3(x1, y0, z), vec3(x1, y1, z), vec3(x0, y1, z));
}

/* Returns the face, so that a test can change it; not its vertices, whose plane is computed here. */
static inline Face *small_scene_face(SmallScene *small, int material, Face face)
{
    int index = small->scene.face_count++;
    face.number = index;
    face.material = material;
    small->faces[index] = face;
    small->planes[index] = face_plane(&face);
    return &small->faces[index];
}

#endif
