/* The part of the picture that a user asks for. */
#ifndef RECTRAY_REGION_H
#define RECTRAY_REGION_H

#include "command/option.h"
#include "scene/scene.h"

/* False, with an ERROR_USAGE that tells what there is, where --region reaches beyond the scene's picture, or --mark is
 * not in what is rendered. */
bool region_check(const Options *options, const Scene *scene, Error *error);

#endif
