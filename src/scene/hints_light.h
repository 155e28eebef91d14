/* Lights that reach nothing of what the camera sees. */
#ifndef RECTRAY_HINTS_LIGHT_H
#define RECTRAY_HINTS_LIGHT_H

#include "scene/hint.h"

bool hint_light_is_black(const Light *light);

/* Adds hints on lights that are shut off from the camera, or behind all that it sees. Returns through *hidden whether
 * there are lights, and all of them are. */
bool hints_find_lights(Hints *hints, const Scene *scene, bool *hidden, Error *error);

#endif
