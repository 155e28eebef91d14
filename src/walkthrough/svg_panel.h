/* The views of a walkthrough's drawing: two along the axes, and these two once more, larger, where hits are close. */
#ifndef RECTRAY_SVG_PANEL_H
#define RECTRAY_SVG_PANEL_H

#include "walkthrough/svg_extent.h"
#include "walkthrough/svg_view.h"
#include "walkthrough/walkthrough.h"

enum { SVG_FACES_MAX = 5000 }; /* of larger scenes only the faces that rays meet are drawn */

typedef struct SvgSheet {
    FILE *out;
    const Walkthrough *walk;
    SvgExtent extent, close; /* what is shown, and what is shown once more */
    bool has_zoom;           /* something is */
    bool has_cut;            /* a face goes on beyond a panel's edge */
    bool failed;             /* for want of memory */
    Error *error;
} SvgSheet;

/* A view in a box of the paper; zoomed: of what is shown once more. */
void svg_panel(SvgSheet *sheet, SvgDirection direction, SvgBox box, bool zoomed);

#endif
