/* A path's colour is at most what all lights add to the brightest material, once for each of its faces. */
#include "scene/hints_black.h"

#include "scene/hints_light.h"
#include "scene/light.h"

#include <stdlib.h>

/* Half of the smallest step of a byte: less is rounded to 0. */
static const double DARK = 0.5 / 255;

/* What is known of the materials that some face has. */
typedef struct Brightness {
    bool has_colour;
    bool reflects_light; /* some light has a colour that some material has, of the same kind */
    bool mirrors;
    double most; /* that all lights can add to a point */
} Brightness;

/* The most that a light can add to a point of the material. */
static double brightest(const Material *material, const Light *light)
{
    return vec3_largest(vec3_multiply(material->ambient, light->ambient)) +
           vec3_largest(vec3_multiply(material->diffuse, light->diffuse)) +
           vec3_largest(vec3_multiply(material->specular, light->specular));
}

static void look_at_material(Brightness *brightness, const Scene *scene, const Material *material)
{
    double sum = 0;
    for (int i = 0; i < scene->light_count; i++)
        sum += brightest(material, &scene->lights[i]);
    brightness->has_colour = brightness->has_colour || !colour_is_black(material->ambient) ||
                             !colour_is_black(material->diffuse) || !colour_is_black(material->specular);
    brightness->reflects_light = brightness->reflects_light || sum > 0;
    brightness->mirrors = brightness->mirrors || material->reflection > 0;
    brightness->most = fmax(brightness->most, sum);
}

static bool look_at_materials(Brightness *brightness, const Scene *scene, Error *error)
{
    bool *used = calloc((size_t)scene->material_count + 1, sizeof *used);
    *brightness = (Brightness){.has_colour = false};
    if (!used)
        return error_memory(error, "the materials of the scene");
    for (int i = 0; i < scene->face_count; i++)
        used[scene->faces[i].material] = true;
    for (int i = 0; i < scene->material_count; i++)
        if (used[i])
            look_at_material(brightness, scene, &scene->materials[i]);
    free(used);
    return true;
}

static bool lights_are_black(const Scene *scene)
{
    for (int i = 0; i < scene->light_count; i++)
        if (!hint_light_is_black(&scene->lights[i]))
            return false;
    return true;
}

bool hints_find_black(Hints *hints, const Scene *scene, bool unseen, bool hidden, Error *error)
{
    Brightness brightness;
    if (!look_at_materials(&brightness, scene, error))
        return false;
    double background = vec3_largest(scene->shading.background), faces = 1;
    if (brightness.mirrors)
        faces += scene->shading.max_bounces;
    int reason = unseen                                            ? BLACK_NO_FACE_SEEN
                 : scene->light_count == 0                         ? BLACK_NO_LIGHT
                 : lights_are_black(scene)                         ? BLACK_LIGHTS_BLACK
                 : !brightness.has_colour                          ? BLACK_NO_COLOUR
                 : !brightness.reflects_light                      ? BLACK_COLOURS_DIFFER
                 : faces * brightness.most < DARK / 2              ? BLACK_TOO_DARK
                 : hidden && scene->shading.shadow == SHADOW_BLACK ? BLACK_LIGHTS_HIDDEN
                                                                   : -1;
    return background >= DARK / 2 || reason < 0 || hint_add(hints, (Hint){HINT_BLACK, reason, -1, 1}, error);
}
