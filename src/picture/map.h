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

/* Draws the map of the scene, by the scale that is given, or, where its high is 0, by that of its own values, which it
 * then receives, on `threads` threads (0: one per processor). The caller frees the image, also after a
 * failure, which is want of memory. */
bool map_draw(Image *image, const Scene *scene, MapKind kind, AccelKind accel, int threads, MapScale *scale,
              Error *error);

#endif
