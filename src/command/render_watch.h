/* Rendering again and again, whenever what a picture is made of changes. */
#ifndef RECTRAY_RENDER_WATCH_H
#define RECTRAY_RENDER_WATCH_H

#include "command/options.h"

/* Calls `render` now and after every change of the scene, its models, their libraries, or the files of the kernels'
 * folder. What fails is told, and the watch goes on. Returns only where watching itself is not possible, or where the
 * command line is wrong the first time. */
bool render_watch(const Options *options, bool (*render)(const Options *, Error *), Error *error);

#endif
