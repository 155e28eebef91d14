/* What a drawing of a walkthrough must show: the path, and the lights that are not too far. */
#ifndef RECTRAY_SVG_EXTENT_H
#define RECTRAY_SVG_EXTENT_H

#include "walkthrough/svg_view.h"
#include "walkthrough/walkthrough.h"

typedef struct SvgExtent {
    Vec3 low, high;
    double lengths[SVG_DIRECTION_COUNT]; /* of the lines, as each view shows them */
    double farthest_light;               /* from the first hit; lights beyond are not looked at */
} SvgExtent;

SvgExtent svg_extent_of(const Walkthrough *walk);

/* What a second drawing shows larger, where two hits in a row are too close to be told apart in the first. */
bool svg_extent_of_close_hits(const Walkthrough *walk, const SvgExtent *all, SvgExtent *close);

/* The view that shows least of the path: it is left out. */
SvgDirection svg_extent_least_shown(const SvgExtent *extent);

#endif
