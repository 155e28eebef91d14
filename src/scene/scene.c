/* What a scene owns, and the two numbers that follow from it. */
#include "scene/scene.h"

#include <stdlib.h>

const char *const scene_shadow_rules[] = {[SHADOW_BLACK] = "black", [SHADOW_AMBIENT] = "ambient"};
const char *const scene_viewer_rules[] = {[VIEWER_CAMERA] = "camera", [VIEWER_RAY] = "ray"};

void scene_free(Scene *scene)
{
    for (int i = 0; i < scene->material_count; i++)
        free(scene->materials[i].name);
    for (int i = 0; i < scene->object_count; i++)
        free(scene->objects[i].name);
    for (int i = 0; i < scene->part_count; i++)
        free(scene->parts[i].name);
    free(scene->lights);
    free(scene->materials);
    free(scene->objects);
    free(scene->parts);
    free(scene->faces);
    free(scene->planes);
    notes_free(&scene->notes);
    *scene = (Scene){0};
}

const char *scene_part_of(const Scene *scene, int face)
{
    int low = -1, high = scene->part_count; /* part `low` begins at or before the face, `high` after it */
    while (high - low > 1) {
        int middle = low + (high - low) / 2;
        if (scene->parts[middle].first_face <= face)
            low = middle;
        else
            high = middle;
    }
    bool inside = low >= 0 && scene->parts[low].first_face >= scene->objects[scene->faces[face].object].first_face;
    return inside && scene->parts[low].name[0] ? scene->parts[low].name : NULL;
}

double screen_height(const Screen *screen)
{
    return screen->height > 0 ? screen->height : screen->width * screen->rows / screen->columns;
}

static double round_to(double step, double x)
{
    return floor(x / step + 0.5) * step;
}

Vec3 scene_centre(Vec3 low, Vec3 high)
{
    Vec3 middle = vec3_add(vec3_scale(0.5, low), vec3_scale(0.5, high));
    Vec3 half = vec3_sub(vec3_scale(0.5, high), vec3_scale(0.5, low));
    double size = 2 * fmax(half.x, fmax(half.y, half.z));
    /* The factor keeps boxes of a round size (1, 2, 4 ...) away from the jump between two powers of two, so that a
     * translation that rounds the size up or down by an ulp does not change the step. */
    int exponent;
    frexp(1.37 * size, &exponent);
    double step = ldexp(1, exponent - 11);
    if (size == 0 || step == 0)
        return middle;
    return vec3(round_to(step, middle.x), round_to(step, middle.y), round_to(step, middle.z));
}
