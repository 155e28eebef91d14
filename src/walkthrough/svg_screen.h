/* The picture on its screen: a panel of a walkthrough's drawing, seen from behind the camera. */
#ifndef RECTRAY_SVG_SCREEN_H
#define RECTRAY_SVG_SCREEN_H

#include "walkthrough/svg_view.h"
#include "walkthrough/walkthrough_formats.h"

/* The screen's outline in a panel. */
void svg_screen_outline(SvgView *view, const Scene *scene);

/* The panel: the camera C, the screen with the picture (NULL: without), the ray through Q, and as much of the path as
 * fits beside them. Views are parallel projections, in which a rectangle is a parallelogram, so the picture is placed
 * by a matrix. */
void svg_screen_panel(FILE *out, const Walkthrough *walk, const WalkthroughPicture *picture, SvgBox box, int number);

#endif
