/* Counts what a scene holds. The side of a plane that a point is on is exact (geometry.h), so "can not be hit"
 * holds for every ray, however it is rounded. */
#include "scene/survey.h"

#include "scene/geometry.h"
#include "scene/light.h"

#include <stdlib.h>

static const Material *material_of(const Scene *scene, const Face *face)
{
    return &scene->materials[face->material];
}

/* A hit is at t > 0, so beyond the camera along its direction of view: a rounding's width of doubt is left out. */
static bool is_behind_camera(const Scene *scene, const Face *face)
{
    Vec3 eye = scene->camera.position;
    Vec3 forward = vec3_unit(vec3_sub(scene->camera.look_at, eye));
    for (int k = 0; k < face->vertex_count; k++) {
        Vec3 to_vertex = vec3_sub(face_vertex(face, k), eye);
        if (vec3_dot(forward, to_vertex) > -1e-12 * vec3_length(to_vertex))
            return false;
    }
    return true;
}

/* Counts the reason why no primary ray can hit the face; false where there is none. */
static bool count_unseen(Survey *survey, const Scene *scene, int index)
{
    const Face *face = &scene->faces[index];
    int side = plane_side(face, &scene->planes[index], scene->camera.position);
    int *reason = NULL;
    if (side == 0)
        reason = &survey->edge_on;
    else if (face->one_sided && side < 0)
        reason = &survey->back_to_camera;
    else if (is_behind_camera(scene, face))
        reason = &survey->behind_camera;
    if (reason)
        ++*reason;
    return reason != NULL;
}

/* Whether a segment from some point to a light can pass through the face: the light is off its plane, and a
 * one-sided face is passed from its front, so the light is behind. */
static bool can_block(const Scene *scene, int index)
{
    const Face *face = &scene->faces[index];
    for (int i = 0; i < scene->light_count; i++) {
        int side = plane_side(face, &scene->planes[index], scene->lights[i].position);
        if (side < 0 || (side > 0 && !face->one_sided))
            return true;
    }
    return false;
}

static void count_lights(Survey *survey, const Scene *scene)
{
    for (int i = 0; i < scene->light_count; i++) {
        const Light *light = &scene->lights[i];
        if (!colour_is_black(light->diffuse) || !colour_is_black(light->specular))
            continue;
        if (colour_is_black(light->ambient))
            survey->lights_black++;
        else
            survey->lights_ambient++;
    }
}

static void count_faces(Survey *survey, const Scene *scene)
{
    for (int i = 0; i < scene->face_count; i++) {
        const Face *face = &scene->faces[i];
        const Material *material = material_of(scene, face);
        survey->material_used[face->material] = true;
        survey->numbers += i == 0 || face->number != face[-1].number;
        survey->triangles += face->vertex_count == 3;
        survey->one_sided += face->one_sided;
        survey->mirrors += material->reflection > 0;
        survey->shiny += !colour_is_black(material->specular);
    }
}

bool survey_materials(Survey *survey, const Scene *scene, Error *error)
{
    *survey = (Survey){0};
    survey->material_used = calloc((size_t)scene->material_count + 1, sizeof *survey->material_used);
    if (!survey->material_used)
        return error_memory(error, "the survey of the scene");
    count_faces(survey, scene);
    count_lights(survey, scene);
    /* Under the black rule a point that no light reaches ends the path: without lights, every first hit. */
    bool goes_on = scene->shading.shadow == SHADOW_AMBIENT || scene->light_count > 0;
    survey->shadow_rays = scene->face_count > 0 && scene->light_count > 0;
    survey->reflections = survey->mirrors > 0 && scene->shading.max_bounces > 0 && goes_on;
    return true;
}

bool survey_scene(Survey *survey, const Scene *scene, Error *error)
{
    if (!survey_materials(survey, scene, error))
        return false;
    for (int i = 0; i < scene->face_count; i++)
        if (count_unseen(survey, scene, i) && !survey->reflections && !can_block(scene, i))
            survey->unreachable++;
    return true;
}

bool survey_face_is_unreachable(const Scene *scene, int index)
{
    Survey uncounted = {0};
    return count_unseen(&uncounted, scene, index) && !can_block(scene, index);
}

void survey_free(Survey *survey)
{
    free(survey->material_used);
    survey->material_used = NULL;
}
