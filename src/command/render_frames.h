/* The frames of a scene that moves, one file each, in one process. */
#ifndef RECTRAY_RENDER_FRAMES_H
#define RECTRAY_RENDER_FRAMES_H

#include "command/options.h"
#include "command/stats.h"
#include "opencl/backend.h"
#include "scene/scene.h"

/* Renders a scene, a frame of the film, into the file `output`. */
typedef bool (*RenderFrame)(const Options *options, Scene *scene, const char *output, BackendFilm *film, Stats *stats,
                            Error *error);

/* Whether several frames are wanted: --frames, or a film as the output. */
bool render_frames_wanted(const Options *options);

/* Renders the frames that --frames asks for, or all, in their order: each to its file, or all to one film. With
 * --resume those whose pictures are there are left out. Errors: options that make no sense with several frames; a
 * pattern that does not name a file for each; those of the scene, of `render` and of the film. */
bool render_frames(const Options *options, RenderFrame render, Error *error);

#endif
