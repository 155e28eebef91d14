/* Builds a Scene: materials, objects and points in world space. */
#include "reader/scene_build.h"

#include "base/array.h"
#include "base/text.h"

#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

static bool fail(SceneBuild *build, const char *format, ...)
{
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(build->reason, sizeof build->reason, format, arguments);
    va_end(arguments);
    return false;
}

int scene_build_material(SceneBuild *build, Material material)
{
    Scene *scene = build->scene;
    Material *grown = array_grown(scene->materials, scene->material_count, &build->material_capacity, sizeof *grown,
                                  "materials", build->error);
    if (!grown)
        return -1;
    scene->materials = grown;
    material.name = text_copy(material.name, build->error);
    if (!material.name)
        return -1;
    scene->materials[scene->material_count] = material;
    return scene->material_count++;
}

bool scene_build_object(SceneBuild *build, const char *name, SceneBuildObject object)
{
    Scene *scene = build->scene;
    Object *grown = array_grown(scene->objects, scene->object_count, &build->object_capacity, sizeof *grown, "objects",
                                build->error);
    if (!grown)
        return false;
    scene->objects = grown;
    char *copy = text_copy(name, build->error);
    if (!copy)
        return false;
    scene->objects[scene->object_count++] =
        (Object){.name = copy, .first_face = build->face_count, .first_number = build->next_number};
    build->first_part = scene->part_count;
    object.mirrored = transform_mirrors(&object.transform);
    object.first_point = build->point_count;
    build->object = object;
    return true;
}

bool scene_build_part(SceneBuild *build, const char *name)
{
    Scene *scene = build->scene;
    ScenePart *last = scene->part_count > build->first_part ? &scene->parts[scene->part_count - 1] : NULL;
    char *copy = text_copy(name, build->error);
    if (!copy)
        return false;
    if (last && last->first_face == build->face_count) { /* it has no face */
        free(last->name);
        last->name = copy;
        return true;
    }
    ScenePart *grown =
        array_grown(scene->parts, scene->part_count, &build->part_capacity, sizeof *grown, "parts", build->error);
    if (!grown) {
        free(copy);
        return false;
    }
    scene->parts = grown;
    grown[scene->part_count++] = (ScenePart){copy, build->face_count};
    return true;
}

void scene_build_end_parts(SceneBuild *build)
{
    Scene *scene = build->scene;
    const Object *object = &scene->objects[scene->object_count - 1];
    int count = scene->part_count - build->first_part;
    if (count == 0)
        return;
    ScenePart *parts = scene->parts + build->first_part;
    if (parts[count - 1].first_face == build->face_count)
        free(parts[--count].name);
    bool one = count > 0 && parts[0].first_face == object->first_face;
    for (int i = 1; i < count; i++)
        one = one && strcmp(parts[i].name, parts[0].name) == 0;
    while (one && count > 0)
        free(parts[--count].name);
    scene->part_count = build->first_part + count;
}

bool scene_build_point(SceneBuild *build, Vec3 point)
{
    Vec3 *grown =
        array_grown(build->points, build->point_count, &build->point_capacity, sizeof *grown, "vertices", build->error);
    if (!grown)
        return false;
    build->points = grown;
    Vec3 world = transform_point(&build->object.transform, point);
    if (!vec3_is_finite(world) && vec3_is_finite(point))
        return fail(build, "the transform takes the vertex out of the range of numbers");
    build->points[build->point_count++] = world;
    return true;
}

int scene_build_point_count(const SceneBuild *build)
{
    return build->point_count - build->object.first_point;
}

const int scene_build_box_faces[BUILD_BOX_FACES][4] = {
    {0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6},
};

Vec3 scene_build_corner(Vec3 low, Vec3 high, int i)
{
    return vec3(i & 1 ? high.x : low.x, i & 2 ? high.y : low.y, i & 4 ? high.z : low.z);
}

bool scene_build_note(SceneBuild *build, NoteName name, const char *path, NotePlace place)
{
    return notes_add(&build->scene->notes, &note_kinds[name], path, place, build->error);
}

bool scene_build_fail_empty(SceneBuild *build, const char *path, const char *reason)
{
    char instead[512] = "";
    const Notes *notes = &build->scene->notes;
    for (int i = 0; i < notes->count; i++) {
        const Note *note = &notes->items[i];
        size_t length = strlen(instead);
        if (strcmp(note->path, path) == 0 && note->kind != &note_kinds[NOTE_LIBRARY_MISSING])
            snprintf(instead + length, sizeof instead - length, "%s%.200s", length ? ", " : "; ",
                     note_summary(note).text);
    }
    return error_set(build->error, ERROR_INPUT, "%s: %s%s", path, reason, instead);
}

bool scene_build_model(SceneBuild *build, const char *path)
{
    SceneBuildModel *grown =
        array_grown(build->models, build->model_count, &build->model_capacity, sizeof *grown, "models", build->error);
    if (!grown)
        return false;
    build->models = grown;
    char *copy = text_copy(path, build->error);
    if (!copy)
        return false;
    build->object.first_number = 1;
    grown[build->model_count++] = (SceneBuildModel){copy, build->scene->object_count - 1};
    return true;
}

bool scene_build_note_face(SceneBuild *build, NoteName name, int object, int place)
{
    char where[48];
    snprintf(where, sizeof where, "face %d", -place); /* of a binary file */
    NotePlace at = {.line = place > 0 ? place : 0, .detail = place > 0 ? NULL : where};
    for (int i = build->model_count - 1; i >= 0; i--)
        if (build->models[i].object == object)
            return scene_build_note(build, name, build->models[i].path, at);
    snprintf(where, sizeof where, "objects[%d].faces[%d]", object, place);
    return scene_build_note(build, name, build->path ? build->path : "", (NotePlace){.detail = where});
}

void scene_build_free(SceneBuild *build)
{
    names_free(&build->materials);
    polygon_cut_free(&build->cut);
    free(build->corners);
    free(build->corner_points);
    for (int i = 0; i < build->model_count; i++)
        free(build->models[i].path);
    free(build->models);
    free(build->points);
    free(build->faces);
    *build = (SceneBuild){0};
}
