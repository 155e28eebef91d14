/* The maps that render draws beside its picture. */
#ifndef RECTRAY_RENDER_MAPS_H
#define RECTRAY_RENDER_MAPS_H

#include "command/options.h"
#include "scene/scene.h"

/* False, with an ERROR_USAGE, where a map cannot be drawn or its file would replace another of this run. */
bool render_maps_check(const Options *options, Error *error);

/* Draws every map into its file, and tells its scale on stderr. */
bool render_maps_draw(const Options *options, const Scene *scene, Error *error);

#endif
