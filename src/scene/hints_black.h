/* Why every pixel of a picture is black. */
#ifndef RECTRAY_HINTS_BLACK_H
#define RECTRAY_HINTS_BLACK_H

#include "scene/hint.h"

/* Adds a hint where the picture is black for certain. unseen: the camera sees no face; hidden: no light reaches what it
 * sees. */
bool hints_find_black(Hints *hints, const Scene *scene, bool unseen, bool hidden, Error *error);

#endif
