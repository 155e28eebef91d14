/* How a drawing shows each kind of line of a walkthrough. */
#ifndef RECTRAY_SVG_STROKES_H
#define RECTRAY_SVG_STROKES_H

#include "walkthrough/walkthrough_lines.h"

typedef struct SvgStroke {
    const char *name, *colour, *width;
} SvgStroke;

/* By WalkthroughLineKind. Shifts are far too short to be drawn. */
extern const SvgStroke svg_strokes[];

#endif
