/* Numbers are hashed by their bits, the lowest byte first, and fields one by one: what lies between them is no part of
 * a scene. */
#include "scene/scene_hash.h"

#include <string.h>

static uint64_t hash_bytes(uint64_t hash, uint64_t value, int bytes)
{
    for (int i = 0; i < bytes; i++)
        hash = (hash ^ (value >> (8 * i) & 255)) * 1099511628211u;
    return hash;
}

static uint64_t hash_int(uint64_t hash, int value)
{
    return hash_bytes(hash, (uint64_t)(uint32_t)value, 4);
}

static uint64_t hash_float(uint64_t hash, float value)
{
    uint32_t bits;
    memcpy(&bits, &value, sizeof bits);
    return hash_bytes(hash, bits, 4);
}

static uint64_t hash_double(uint64_t hash, double value)
{
    uint64_t bits;
    memcpy(&bits, &value, sizeof bits);
    return hash_bytes(hash, bits, 8);
}

static uint64_t hash_vec3(uint64_t hash, Vec3 v)
{
    return hash_double(hash_double(hash_double(hash, v.x), v.y), v.z);
}

uint64_t scene_hash_text(uint64_t hash, const char *text)
{
    for (; *text; text++)
        hash = hash_bytes(hash, (unsigned char)*text, 1);
    return hash_bytes(hash, 0, 1);
}

/* --- What a scene holds --- */

static uint64_t hash_view(uint64_t hash, const Scene *scene)
{
    const Screen *screen = &scene->screen;
    hash = hash_vec3(hash_vec3(hash_vec3(hash, scene->camera.position), scene->camera.look_at), scene->camera.up);
    hash = hash_int(hash_int(hash, screen->columns), screen->rows);
    hash = hash_double(hash_double(hash_double(hash, screen->distance), screen->width), screen->height);
    hash = hash_int(hash_int(hash, scene->grid), scene->adaptive);
    return hash_vec3(hash, scene->centre);
}

static uint64_t hash_shading(uint64_t hash, const Scene *scene)
{
    hash = hash_int(hash_int(hash, (int)scene->shading.shadow), (int)scene->shading.viewer);
    hash = hash_vec3(hash_int(hash, scene->shading.max_bounces), scene->shading.background);
    hash = hash_int(hash, scene->light_count);
    for (int i = 0; i < scene->light_count; i++) {
        const Light *light = &scene->lights[i];
        hash = hash_vec3(hash_vec3(hash, light->position), light->ambient);
        hash = hash_vec3(hash_vec3(hash, light->diffuse), light->specular);
    }
    hash = hash_int(hash, scene->material_count);
    for (int i = 0; i < scene->material_count; i++) {
        const Material *material = &scene->materials[i];
        hash = hash_vec3(hash_vec3(hash_vec3(hash, material->ambient), material->diffuse), material->specular);
        hash = hash_double(hash_double(hash, material->shininess), material->reflection);
    }
    return hash;
}

static uint64_t hash_face(uint64_t hash, const Face *face)
{
    for (int i = 0; i < face->vertex_count; i++)
        for (int axis = 0; axis < 3; axis++)
            hash = hash_float(hash, face->vertices[i][axis]);
    return hash_int(hash_int(hash_int(hash, face->vertex_count), face->material), face->one_sided);
}

uint64_t scene_hash_all(uint64_t hash, const Scene *scene)
{
    hash = hash_shading(hash_view(hash, scene), scene);
    hash = hash_int(hash, scene->face_count);
    for (int i = 0; i < scene->face_count; i++)
        hash = hash_face(hash, &scene->faces[i]);
    return hash;
}
