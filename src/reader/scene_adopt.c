/* Points and faces that a reader has put into the arrays of the build itself. */
#include "base/array.h"
#include "reader/scene_build.h"

/* False where the transform takes a point out of the range of numbers. */
static bool move_points(const SceneBuild *build, Vec3 *points, int count)
{
    bool finite = true;
    for (int i = 0; i < count; i++) {
        points[i] = transform_point(&build->object.transform, points[i]);
        finite = finite && vec3_is_finite(points[i]);
    }
    return finite;
}

/* The numbers of the points that a face has in its object become the scene's. A mirror turns the face over. */
static bool adopt_face(const SceneBuild *build, SceneBuildFace *face, int index, int points)
{
    int count = face->vertex_count, own[4];
    for (int i = 0; i < count; i++) {
        own[i] = face->points[i];
        if (own[i] < 0 || own[i] >= points)
            return false;
    }
    for (int i = 0; i < count; i++)
        face->points[i] = build->object.first_point + own[build->object.mirrored ? (count - i) % count : i];
    face->material = face->material < 0 ? build->object.material : face->material;
    face->number = build->next_number + index;
    face->object = build->scene->object_count - 1;
    face->one_sided = build->object.one_sided;
    face->skip = build->object.skip;
    face->shape = build->object.mirrored ? BUILD_SHAPE_UNCHECKED_TURNED : BUILD_SHAPE_UNCHECKED;
    return face->material >= 0;
}

bool scene_build_adopt(SceneBuild *build, int points, int faces)
{
    if (points > 0 && !move_points(build, build->points + build->point_count, points))
        return false;
    for (int i = 0; i < faces; i++)
        if (!adopt_face(build, &build->faces[build->face_count + i], i, points))
            return false;
    build->point_count += points;
    build->face_count += faces;
    build->next_number += faces;
    return true;
}

Vec3 *scene_build_next_point(SceneBuild *build, int behind)
{
    int count = build->point_count + behind;
    if (count >= build->point_capacity) {
        Vec3 *grown =
            array_grown(build->points, count, &build->point_capacity, sizeof *grown, "vertices", build->error);
        if (!grown)
            return NULL;
        build->points = grown;
    }
    return &build->points[count];
}

SceneBuildFace *scene_build_next_face(SceneBuild *build, int behind)
{
    int count = build->face_count + behind;
    if (count >= build->face_capacity) {
        SceneBuildFace *grown =
            array_grown(build->faces, count, &build->face_capacity, sizeof *grown, "faces", build->error);
        if (!grown)
            return NULL;
        build->faces = grown;
    }
    return &build->faces[count];
}

bool scene_build_adopt_box(SceneBuild *build, Vec3 low, Vec3 high)
{
    for (int i = 0; i < BUILD_BOX_POINTS; i++) {
        Vec3 *point = scene_build_next_point(build, i);
        if (!point)
            return false;
        *point = scene_build_corner(low, high, i);
    }
    for (int i = 0; i < BUILD_BOX_FACES; i++) {
        SceneBuildFace *face = scene_build_next_face(build, i);
        if (!face)
            return false;
        *face = (SceneBuildFace){.material = -1, .vertex_count = 4, .place = i};
        for (int k = 0; k < 4; k++)
            face->points[k] = scene_build_box_faces[i][k];
    }
    return scene_build_adopt(build, BUILD_BOX_POINTS, BUILD_BOX_FACES);
}
