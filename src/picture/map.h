/* Maps: pictures of what a picture was made of, pixel by pixel. The reference tracer makes them, whichever backend
 * renders the picture. To add one: a kind in render.h, its word in option_table.c, its case in map.c, its line in
 * docs/commands.md. */
#ifndef RECTRAY_MAP_H
#define RECTRAY_MAP_H

#include "picture/image.h"
#include "scene/scene.h"
#include "trace/accel.h"

/* The values from which the colours run to which; both 0 where no pixel has one, and for normals and faces. */
typedef struct MapScale {
    double low, high;
} MapScale;

/* Whether its colours run between two numbers: all but normals and faces. */
bool map_has_scale(MapKind kind);

/* Draws the map of the picture, or of the region that the settings name, with their tree and on so many threads as they
 * say, by the scale that is given, or, where its high is 0, by that of the map's own values, which it then receives.
 * The caller frees the image, also after a failure, which is want of memory. */
bool map_draw(Image *image, const Scene *scene, MapKind kind, const RenderSettings *settings, MapScale *scale,
              Error *error);

#endif
