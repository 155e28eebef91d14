/* A scene without black lights, without faces that no ray reaches, and without bounces where nothing reflects. What is
 * left out is certain not to matter, for the sides of planes are exact (geometry.h). */
#include "trace/pruned_scene.h"

#include "scene/light.h"
#include "scene/survey.h"
#include "trace/skip.h"

#include <stdlib.h>

/* Unreachable faces are looked for in scenes of up to so many: in
 * larger ones the search would cost more than it could save. */
enum { UNREACHABLE_FACES_MOST = 10000 };

static bool light_is_black(const Light *light)
{
    return colour_is_black(light->ambient) && colour_is_black(light->diffuse) && colour_is_black(light->specular);
}

/* The lights that have a colour. */
static bool keep_lights(PrunedScene *pruned, const Scene *scene, Error *error)
{
    pruned->lights = malloc(((size_t)scene->light_count + 1) * sizeof *pruned->lights);
    if (!pruned->lights)
        return error_memory(error, "the lights");
    int kept = 0;
    for (int i = 0; i < scene->light_count; i++)
        if (!light_is_black(&scene->lights[i]))
            pruned->lights[kept++] = scene->lights[i];
    pruned->scene.lights = pruned->lights;
    pruned->scene.light_count = kept;
    return true;
}

/* The faces that a ray can hit. */
static bool keep_faces(PrunedScene *pruned, const Scene *scene, Error *error)
{
    size_t room = (size_t)scene->face_count + 1;
    pruned->faces = malloc(room * sizeof *pruned->faces);
    pruned->planes = malloc(room * sizeof *pruned->planes);
    if (!pruned->faces || !pruned->planes)
        return error_memory(error, "the faces");
    int kept = 0;
    for (int i = 0; i < scene->face_count; i++)
        if (!survey_face_is_unreachable(scene, i)) {
            pruned->faces[kept] = scene->faces[i];
            pruned->planes[kept++] = scene->planes[i];
        }
    pruned->scene.faces = pruned->faces;
    pruned->scene.planes = pruned->planes;
    pruned->scene.face_count = kept;
    return true;
}

bool pruned_scene_make(PrunedScene *pruned, const Scene *scene, const RenderSettings *settings, RenderReport *report,
                       Error *error)
{
    *pruned = (PrunedScene){.scene = *scene};
    Survey survey;
    if (!survey_materials(&survey, scene, error))
        return false;
    bool reflections = survey.reflections;
    int black = survey.lights_black;
    survey_free(&survey);
    /* No path goes on after its first hit. */
    if (!reflections && !scene->adaptive && skip_wanted(settings, SKIP_MIRRORS)) {
        pruned->scene.shading.max_bounces = 0;
        report->skipped[SKIP_MIRRORS] = 1;
    }
    /* Adaptive sampling looks at faces that no ray hits and at shadows of black lights, too: they may make it cast more
     * rays. Under the black rule a path goes on from where a light reaches, be it black. */
    bool black_adds_nothing = !reflections || scene->shading.shadow == SHADOW_AMBIENT;
    if (black > 0 && black_adds_nothing && !scene->adaptive && skip_wanted(settings, SKIP_LIGHT_BLACK)) {
        if (!keep_lights(pruned, scene, error))
            return false;
        report->skipped[SKIP_LIGHT_BLACK] = (uint64_t)black;
    }
    if (!reflections && !scene->adaptive && scene->face_count <= UNREACHABLE_FACES_MOST &&
        skip_wanted(settings, SKIP_UNREACHABLE_FACE)) {
        if (!keep_faces(pruned, scene, error))
            return false;
        report->skipped[SKIP_UNREACHABLE_FACE] = (uint64_t)(scene->face_count - pruned->scene.face_count);
    }
    return true;
}

void pruned_scene_free(PrunedScene *pruned)
{
    free(pruned->lights);
    free(pruned->faces);
    free(pruned->planes);
    *pruned = (PrunedScene){.lights = NULL};
}
