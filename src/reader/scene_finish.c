/* The last step of building a scene: around its own centre, rounded once to float32, with the planes of its faces. */
#include "reader/scene_build.h"
#include "scene/geometry.h"

#include <stdio.h>
#include <stdlib.h>

static bool fail(SceneBuild *build, const SceneBuildFace *face, const char *reason)
{
    snprintf(build->reason, sizeof build->reason, "%s", reason);
    build->fault = face;
    return false;
}

/* The middle of all vertices that faces use; of the camera, where there is no face. */
static Vec3 centre_of(const SceneBuild *build)
{
    Vec3 low = build->scene->camera.position, high = low;
    for (int i = 0; i < build->face_count; i++)
        for (int k = 0; k < build->faces[i].vertex_count; k++) {
            Vec3 p = build->points[build->faces[i].points[k]];
            bool first = i == 0 && k == 0;
            low = first ? p : vec3(fmin(low.x, p.x), fmin(low.y, p.y), fmin(low.z, p.z));
            high = first ? p : vec3(fmax(high.x, p.x), fmax(high.y, p.y), fmax(high.z, p.z));
        }
    return scene_centre(low, high);
}

/* Written so that a NaN is out of range, too. */
static bool in_range(Vec3 a)
{
    return fabs(a.x) <= BUILD_MAX_COORDINATE && fabs(a.y) <= BUILD_MAX_COORDINATE && fabs(a.z) <= BUILD_MAX_COORDINATE;
}

Shape scene_build_shape(const SceneBuild *build, const SceneBuildFace *face)
{
    Vec3 points[4];
    int count = face->vertex_count;
    bool turned = face->shape == BUILD_SHAPE_UNCHECKED_TURNED;
    for (int i = 0; i < count; i++)
        points[i] = build->points[face->points[turned ? (count - i) % count : i]];
    return shape_of(points, count);
}

static bool round_face(SceneBuild *build, const SceneBuildFace *from, Face *face)
{
    if (from->shape != BUILD_SHAPE_CHECKED && scene_build_shape(build, from).verdict)
        return fail(build, from, "the face's shape is not valid");
    *face = (Face){
        .vertex_count = from->vertex_count,
        .number = from->number,
        .object = from->object,
        .material = from->material,
        .one_sided = from->one_sided,
    };
    Vec3 rounded[4];
    for (int k = 0; k < 4; k++) {
        int i = k < from->vertex_count ? k : 0;
        Vec3 p = vec3_sub(build->points[from->points[i]], build->scene->centre);
        if (!in_range(p))
            return fail(build, from, "the face reaches more than 1e12 units from the centre of the scene");
        face->vertices[k][0] = (float)p.x;
        face->vertices[k][1] = (float)p.y;
        face->vertices[k][2] = (float)p.z;
        rounded[k] = face_vertex(face, k);
    }
    if (shape_of_rounded(rounded, face->vertex_count).verdict)
        return fail(build, from,
                    "the face is too small for its distance from the centre of the scene: rounded to float32 it "
                    "loses its area or its shape");
    return true;
}

/* The direction from the camera to where it looks must survive the move: far from the centre, a look_at very near to
 * the camera would be rounded to another direction, or onto the camera. */
static bool move_camera(SceneBuild *build)
{
    Camera *camera = &build->scene->camera;
    Vec3 before = vec3_sub(camera->look_at, camera->position);
    camera->position = vec3_sub(camera->position, build->scene->centre);
    camera->look_at = vec3_sub(camera->look_at, build->scene->centre);
    build->fault_light = -1;
    if (!in_range(camera->position) || !in_range(camera->look_at))
        return fail(build, NULL, "the camera is more than 1e12 units from the centre of the scene");
    Vec3 after = vec3_sub(camera->look_at, camera->position);
    double length = vec3_length(after);
    if (!(length > 0 && vec3_length(vec3_sub(after, before)) <= 1e-9 * length))
        return fail(build, NULL,
                    "\"look_at\" is too near to \"position\" for their distance from the centre of the scene");
    return true;
}

static bool move_lights(SceneBuild *build)
{
    Scene *scene = build->scene;
    for (int i = 0; i < scene->light_count; i++) {
        scene->lights[i].position = vec3_sub(scene->lights[i].position, scene->centre);
        build->fault_light = i;
        if (!in_range(scene->lights[i].position))
            return fail(build, NULL, "the light is more than 1e12 units from the centre of the scene");
    }
    return true;
}

bool scene_build_finish(SceneBuild *build)
{
    Scene *scene = build->scene;
    int count = build->face_count;
    scene->centre = centre_of(build);
    scene->faces = malloc((size_t)count * sizeof *scene->faces + 1); /* + 1: not NULL for no faces */
    scene->planes = malloc((size_t)count * sizeof *scene->planes + 1);
    if (!scene->faces || !scene->planes)
        return error_memory(build->error, "faces");
    for (int i = 0; i < count; i++) {
        if (!round_face(build, &build->faces[i], &scene->faces[i]))
            return false;
        scene->planes[i] = face_plane(&scene->faces[i]);
        scene->objects[scene->faces[i].object].face_count++;
    }
    scene->face_count = count;
    return move_camera(build) && move_lights(build);
}
