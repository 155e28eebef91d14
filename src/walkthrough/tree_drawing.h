/* A tree's boxes, level by level, as a drawing or as a model. */
#ifndef RECTRAY_TREE_DRAWING_H
#define RECTRAY_TREE_DRAWING_H

#include "scene/scene.h"
#include "trace/accel.h"

#include <stdio.h>

/* Two views, each level in a colour of its own. */
void tree_drawing_svg(FILE *out, const Scene *scene, const Accel *accel, const char *scene_name);

/* Lines in groups level_0, level_1, ... */
void tree_drawing_obj(FILE *out, const Scene *scene, const Accel *accel, const char *scene_name);

#endif
