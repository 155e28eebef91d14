/* The last step of building a scene: around its own centre, rounded once to float32, with the planes of its faces.
 * finish_faces.c has the faces' part. */
#include "reader/finish_faces.h"

#include <stdio.h>
#include <stdlib.h>

static bool fail(SceneBuild *build, const SceneBuildFace *face, const char *reason)
{
    snprintf(build->reason, sizeof build->reason, "%s", reason);
    build->fault = face;
    return false;
}

/* Written so that a NaN is out of range, too. */
static bool in_range(Vec3 a)
{
    return fabs(a.x) <= BUILD_MAX_COORDINATE && fabs(a.y) <= BUILD_MAX_COORDINATE && fabs(a.z) <= BUILD_MAX_COORDINATE;
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

bool scene_build_place(SceneBuild *build)
{
    return move_camera(build) && move_lights(build);
}

/* An object's faces stand together, in the order of the objects. */
static void count_faces(Scene *scene)
{
    for (int i = 0; i < scene->object_count; i++) {
        int next = i + 1 < scene->object_count ? scene->objects[i + 1].first_face : scene->face_count;
        scene->objects[i].face_count = next - scene->objects[i].first_face;
    }
}

bool scene_build_finish(SceneBuild *build)
{
    Scene *scene = build->scene;
    size_t count = (size_t)build->face_count;
    Vec3 low = scene->camera.position, high = low; /* where there is no face */
    if (!finish_faces_check(build, &low, &high))
        return false;
    scene->centre = scene_centre(low, high);
    scene->faces = malloc(count * sizeof *scene->faces + 1); /* + 1: not NULL for no faces */
    scene->planes = malloc(count * sizeof *scene->planes + 1);
    if (!scene->faces || !scene->planes)
        return error_memory(build->error, "faces");
    if (!finish_faces_round(build))
        return false;
    count_faces(scene);
    return scene_build_place(build);
}
