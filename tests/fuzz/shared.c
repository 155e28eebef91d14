/* Inputs as files, and the promises that hold for all of them. */
#define _GNU_SOURCE /* memfd_create */
#include "fuzz.h"

#include "trace/reference.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <unistd.h>

void fuzz_broken(const char *promise, const char *file, int line)
{
    fprintf(stderr, "%s:%d: broken: %s\n", file, line, promise);
    abort();
}

const char *fuzz_file(int number, const uint8_t *data, size_t size)
{
    static char paths[2][32];
    int i = number - FUZZ_MODEL;
    if (!paths[i][0]) {
        REQUIRE(dup2(memfd_create("input", 0), number) == number);
        snprintf(paths[i], sizeof paths[i], "/proc/self/fd/%d", number);
    }
    REQUIRE(ftruncate(number, 0) == 0 && pwrite(number, data, size, 0) == (ssize_t)size);
    return paths[i];
}

size_t fuzz_cut(const uint8_t **data, size_t *size)
{
    static const char mark[] = "\n---\n";
    const size_t length = sizeof mark - 1;
    for (size_t i = 0; i + length <= *size; i++)
        if (memcmp(*data + i, mark, length) == 0) {
            *data += i + length;
            *size -= i + length;
            return i + 1;
        }
    size_t all = *size;
    *data += all;
    *size = 0;
    return all;
}

void fuzz_check_error(const Error *error)
{
    REQUIRE(error->kind != ERROR_NONE);
    REQUIRE(error->text[0]);
    for (const char *c = error->text; *c; c++)
        REQUIRE(((unsigned char)*c >= 0x20 && *c != 0x7F) || *c == '\n' || *c == '\t');
}

static void check_face(const Scene *scene, int i)
{
    const Face *face = &scene->faces[i];
    const Plane *plane = &scene->planes[i];
    REQUIRE(face->vertex_count == 3 || face->vertex_count == 4);
    REQUIRE(face->object >= 0 && face->object < scene->object_count);
    REQUIRE(face->material >= 0 && face->material < scene->material_count);
    REQUIRE(face->one_sided == 0 || face->one_sided == 1);
    REQUIRE(i == 0 || face->number >= scene->faces[i - 1].number);
    REQUIRE(i == 0 || face->object >= scene->faces[i - 1].object);
    for (int k = 0; k < 4; k++)
        REQUIRE(vec3_is_finite(face_vertex(face, k)));
    REQUIRE(fabs(vec3_length(plane->normal) - 1) < 1e-12);
    REQUIRE(isfinite(plane->d) && isfinite(plane->error) && plane->length > 0);
}

static void check_numbers(const Scene *scene)
{
    REQUIRE(vec3_is_finite(scene->centre) && vec3_is_finite(scene->camera.position));
    REQUIRE(scene->screen.columns >= 1 && scene->screen.columns <= SCENE_MAX_PIXELS);
    REQUIRE(scene->screen.rows >= 1 && scene->screen.rows <= SCENE_MAX_PIXELS);
    REQUIRE(scene->grid >= 1 && scene->grid <= SCENE_MAX_GRID);
    REQUIRE(scene->shading.max_bounces >= 0 && scene->shading.max_bounces <= SCENE_MAX_BOUNCES);
    int faces = 0;
    for (int i = 0; i < scene->object_count; i++) {
        REQUIRE(scene->objects[i].name && scene->objects[i].first_face == faces);
        faces += scene->objects[i].face_count;
    }
    REQUIRE(faces == scene->face_count);
    for (int i = 0; i < scene->face_count; i++)
        check_face(scene, i);
    for (int i = 0; i < scene->material_count; i++) {
        const Material *material = &scene->materials[i];
        REQUIRE(material->name && material->reflection >= 0 && material->reflection <= 1);
        REQUIRE(material->shininess >= 0 && material->shininess <= SCENE_MAX_SHININESS);
    }
}

/* A picture of 3 x 2 pixels: each found without a tree, then through each. */
static void check_pixels(Scene scene)
{
    static const AccelKind kinds[] = {ACCEL_NONE, ACCEL_BVH, ACCEL_KDTREE, ACCEL_LBVH};
    Vec3 expected[6];
    scene.screen.height = screen_height(&scene.screen); /* of the whole picture */
    scene.screen.columns = 3;
    scene.screen.rows = 2;
    scene.grid = scene.adaptive ? 2 : 1;
    for (int k = 0; k < 4; k++) {
        Error error = {.kind = ERROR_NONE};
        Accel accel;
        RenderReport report = {.threads = 1};
        REQUIRE(accel_build(&accel, &scene, kinds[k], 1, &error));
        Tracer tracer = {.scene = &scene, .accel = &accel, .report = &report};
        for (int i = 0; i < 6; i++) {
            Vec3 colour = reference_pixel(&tracer, i % 3, i / 3);
            REQUIRE(vec3_is_finite(colour));
            REQUIRE(k == 0 || memcmp(&colour, &expected[i], sizeof colour) == 0);
            expected[i] = colour;
        }
        accel_free(&accel);
    }
}

void fuzz_check_scene(const Scene *scene)
{
    check_numbers(scene);
    if ((double)scene->face_count * (scene->light_count + 1) * (scene->shading.max_bounces + 1) < 1e5)
        check_pixels(*scene);
}
