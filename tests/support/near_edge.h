/* Where a float kernel's picture may differ from the reference's: beside an edge of a face or of a shadow, in a mirror,
 * too. There rounding decides on which side a ray passes. */
#ifndef RECTRAY_TESTS_NEAR_EDGE_H
#define RECTRAY_TESTS_NEAR_EDGE_H

#include "scene/scene.h"

/* Do the 3 x 3 pixels around this one, in samples of 1/8 of a pixel, show more than one kind of path? */
bool is_near_edge(const Scene *scene, int column, int row);

#endif
