/* The faces of an object: the good ones as they are, the others as the pieces that scene_polygon.h makes of them. */
#include "base/array.h"
#include "reader/scene_build.h"
#include "reader/scene_polygon.h"

#include <assert.h>
#include <stdio.h>
#include <string.h>

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
        .number = build->next_number,
        .object = build->scene->object_count - 1,
        .material = material,
        .place = place,
        .vertex_count = (unsigned char)count,
        .one_sided = build->object.one_sided,
        .skip = build->object.skip,
    };
    for (int i = 0; i < count; i++)
        face.points[i] = build->object.first_point + points[build->object.mirrored ? (count - i) % count : i];
    build->faces[build->face_count++] = face;
    return true;
}

static bool is_good(const SceneBuild *build, const int *vertices, int count)
{
    Vec3 points[4];
    if (count < 3 || count > 4)
        return false;
    for (int i = 0; i < count; i++) {
        assert(vertices[i] >= 0 && vertices[i] < scene_build_point_count(build));
        points[i] = build->points[build->object.first_point + vertices[i]];
    }
    return shape_of(points, count).verdict == SHAPE_GOOD;
}

static bool add_pieces(SceneBuild *build, const int *vertices, int count, int material, int place)
{
    if (!scene_polygon_cut(build, vertices, count, place))
        return false;
    for (int i = 0; i < build->cut.ring.piece_count; i++) {
        const PolygonPiece *piece = &build->cut.ring.pieces[i];
        int points[4];
        for (int k = 0; k < piece->count; k++)
            points[k] = build->corners[piece->corners[k]];
        if (!add_face(build, points, piece->count, material, place))
            return false;
    }
    return true;
}

bool scene_build_face(SceneBuild *build, const int *vertices, int count, int material, int place)
{
    if (material < 0)
        material = build->object.material;
    if (material < 0) {
        snprintf(build->reason, sizeof build->reason, "the face has no material: neither it nor its object names one");
        return false;
    }
    bool added = is_good(build, vertices, count) ? add_face(build, vertices, count, material, place)
                                                 : add_pieces(build, vertices, count, material, place);
    build->next_number += added;
    return added;
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
            snprintf(build->reason, sizeof build->reason, "side %s of the box: %.200s", sides[i], reason);
            return false;
        }
    return true;
}
