/* The search for hints (hint.h) on a scene. */
#ifndef RECTRAY_HINTS_H
#define RECTRAY_HINTS_H

#include "scene/hint.h"

/* All hints on a scene; false without memory. hints_free may be called in any case. */
bool hints_find(Hints *hints, const Scene *scene, Error *error);

/* Those that explain a picture of one colour: HINT_NO_FACE_SEEN and HINT_BLACK. */
bool hints_find_blank(Hints *hints, const Scene *scene, Error *error);

#endif
