/* Faces that overlap in one plane: only the first of them is seen, or rounding decides for each pixel. */
#ifndef RECTRAY_HINTS_PLANE_H
#define RECTRAY_HINTS_PLANE_H

#include "scene/hint.h"

/* Adds one hint: the first pair of faces of different materials that overlap in a plane, and how many there are. */
bool hints_find_planes(Hints *hints, const Scene *scene, Error *error);

#endif
