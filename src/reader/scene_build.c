/* Builds a Scene: objects, points and faces in world space, then the move to the centre and the rounding. */
#include "reader/scene_build.h"

#include "base/array.h"
#include "base/text.h"
#include "scene/geometry.h"

#include <assert.h>
#include <limits.h>
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
    scene->objects[scene->object_count++] = (Object){.name = copy, .first_face = build->face_count};
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
    ScenePart *parts = scene->parts + build->first_part;
    int count = scene->part_count - build->first_part;
    if (count > 0 && parts[count - 1].first_face == build->face_count)
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

static bool describe(SceneBuild *build, Shape shape, const int *vertices)
{
    int from = build->object.first_number;
    int first = vertices[shape.first] + from, second = vertices[shape.second] + from;
    switch (shape.verdict) {
    case SHAPE_REPEATED:
        if (first == second)
            return fail(build, "the face uses vertex %d twice", first);
        return fail(build, "vertices %d and %d of the face are the same point", first, second);
    case SHAPE_NO_AREA:
        return fail(build, "the face has no area: its vertices lie on one line");
    case SHAPE_NOT_PLANAR:
        return fail(
            build,
            "the face is not planar: vertex %d is %.6g from its plane, and 1e-5 of the longer diagonal (%.6g) is "
            "allowed; \"nonplanar\": \"split\" would make it two triangles",
            first, shape.distance, 1e-5 * shape.diagonal);
    case SHAPE_CONCAVE:
        return fail(build, "the face is not convex: it turns the other way at vertex %d", first);
    case SHAPE_CROSSED:
        return fail(build, "the face is a bow-tie: two of its sides cross; list its vertices in order around it");
    case SHAPE_NOT_FINITE:
        return fail(build, "vertex %d of the face is not a finite number", first);
    case SHAPE_GOOD:
        break;
    }
    return true;
}

/* A mirror turns the right-hand rule round: vertices 0 1 2 3
 * are then stored as 0 3 2 1, and the front stays the front. */
static bool add_face(SceneBuild *build, const int *points, int count, int material, int place)
{
    SceneBuildFace *grown =
        array_grown(build->faces, build->face_count, &build->face_capacity, sizeof *grown, "faces", build->error);
    if (!grown)
        return false;
    build->faces = grown;
    SceneBuildFace face = {
        .vertex_count = (unsigned char)count,
        .number = build->next_number,
        .object = build->scene->object_count - 1,
        .material = material,
        .one_sided = build->object.one_sided,
        .place = place,
    };
    for (int i = 0; i < count; i++)
        face.points[i] = build->object.first_point + points[build->object.mirrored ? (count - i) % count : i];
    build->faces[build->face_count++] = face;
    return true;
}

static Shape shape_at(const SceneBuild *build, const int *vertices, int count)
{
    Vec3 points[4];
    for (int i = 0; i < count; i++) {
        assert(vertices[i] >= 0 && vertices[i] < scene_build_point_count(build));
        points[i] = build->points[build->object.first_point + vertices[i]];
    }
    return shape_of(points, count);
}

bool scene_build_face(SceneBuild *build, const int *vertices, int count, int material, int place)
{
    if (material < 0)
        material = build->object.material;
    if (material < 0)
        return fail(build, "the face has no material: neither it nor its object names one");
    Shape shape = shape_at(build, vertices, count);
    if (shape.verdict == SHAPE_NOT_PLANAR && build->object.split) {
        const int halves[2][3] = {{vertices[0], vertices[1], vertices[2]}, {vertices[0], vertices[2], vertices[3]}};
        for (int i = 0; i < 2; i++)
            if (!describe(build, shape_at(build, halves[i], 3), halves[i]) ||
                !add_face(build, halves[i], 3, material, place))
                return false;
    } else if (!describe(build, shape, vertices) || !add_face(build, vertices, count, material, place))
        return false;
    build->next_number++;
    return true;
}

const int scene_build_box_faces[BUILD_BOX_FACES][4] = {
    {0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6},
};

Vec3 scene_build_corner(Vec3 low, Vec3 high, int i)
{
    return vec3(i & 1 ? high.x : low.x, i & 2 ? high.y : low.y, i & 4 ? high.z : low.z);
}

bool scene_build_box(SceneBuild *build, Vec3 low, Vec3 high)
{
    static const char *const sides[6] = {"-x", "+x", "-y", "+y", "-z", "+z"};
    for (int i = 0; i < BUILD_BOX_POINTS; i++)
        if (!scene_build_point(build, scene_build_corner(low, high, i)))
            return false;
    for (int i = 0; i < BUILD_BOX_FACES; i++)
        if (!scene_build_face(build, scene_build_box_faces[i], 4, -1, i)) {
            char reason[sizeof build->reason];
            memcpy(reason, build->reason, sizeof reason);
            return fail(build, "side %s of the box: %.200s", sides[i], reason);
        }
    return true;
}

bool scene_build_note(SceneBuild *build, NoteName name, const char *path, NotePlace place)
{
    return notes_add(&build->scene->notes, &note_kinds[name], path, place, build->error);
}

void scene_build_free(SceneBuild *build)
{
    names_free(&build->materials);
    free(build->points);
    free(build->faces);
    *build = (SceneBuild){0};
}
