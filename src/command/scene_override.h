/* What the command line says instead of the scene: --size, --grid, --sampling, --bounces. */
#ifndef RECTRAY_SCENE_OVERRIDE_H
#define RECTRAY_SCENE_OVERRIDE_H

#include "command/option.h"
#include "scene/scene.h"

/* The screen's width and height stay: other numbers of columns and rows cut the same view into other pixels. */
void scene_override(Scene *scene, const Options *options);

#endif
