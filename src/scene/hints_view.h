/* Whether the camera sees any face. */
#ifndef RECTRAY_HINTS_VIEW_H
#define RECTRAY_HINTS_VIEW_H

#include "scene/hint.h"

/* Adds a hint where the camera can see no face, or all that it sees is less than a pixel wide or high. Of a scene
 * without faces there is none. Returns through *unseen whether no ray from the camera can hit a face. */
bool hints_find_view(Hints *hints, const Scene *scene, bool *unseen, Error *error);

#endif
