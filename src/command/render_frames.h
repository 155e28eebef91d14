/* The frames of a scene that moves, one file each, in one process. */
#ifndef RECTRAY_RENDER_FRAMES_H
#define RECTRAY_RENDER_FRAMES_H

#include "command/options.h"
#include "command/stats.h"
#include "scene/scene.h"

/* Renders a scene into the file `output`. */
typedef bool (*RenderFrame)(const Options *options, Scene *scene, const char *output, Stats *stats, Error *error);

/* Renders the frames that --frames asks for, in their order. With --resume those whose pictures are there are left
 * out. Errors: options that make no sense with several frames; a pattern that does not name a file for each; those of
 * the scene, and of `render`. */
bool render_frames(const Options *options, RenderFrame render, Error *error);

#endif
