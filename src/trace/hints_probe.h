/* Hints that take rays to find: lights that nothing seen is reached by, and pictures that come out blank. */
#ifndef RECTRAY_HINTS_PROBE_H
#define RECTRAY_HINTS_PROBE_H

#include "scene/hint.h"

/* Traces some pixels of the scene, spread over the picture, and adds a HINT_LIGHT_HIDDEN, a HINT_NO_FACE_SEEN or a
 * HINT_BLACK where no hint says so yet. What few pixels show may be missed. Very large scenes are not probed. blank:
 * the picture is known to have one colour. */
bool hints_probe(Hints *hints, const Scene *scene, bool blank, Error *error);

#endif
