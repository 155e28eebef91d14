/* What the command line says instead of the scene. */
#include "command/scene_override.h"

void scene_override(Scene *scene, const Options *options)
{
    if (options->columns > 0) {
        scene->screen.columns = options->columns;
        scene->screen.rows = options->rows;
    }
    if (options->grid > 0)
        scene->grid = options->grid;
    if (options->sampling != SAMPLING_OF_SCENE)
        scene->adaptive = options->sampling == SAMPLING_ADAPTIVE;
    if (options->bounces >= 0)
        scene->shading.max_bounces = options->bounces;
}
