/* The formats of a walkthrough, one file each. They write to a stream, whose errors the caller looks at. */
#ifndef RECTRAY_WALKTHROUGH_FORMATS_H
#define RECTRAY_WALKTHROUGH_FORMATS_H

#include "walkthrough/walkthrough.h"

typedef struct WalkthroughStyle {
    bool colour;     /* text: ANSI colours */
    bool with_scene; /* OBJ: the scene's faces, too */
} WalkthroughStyle;

/* Fails only for want of memory. */
typedef bool WalkthroughWriter(FILE *out, const Walkthrough *walk, WalkthroughStyle style, Error *error);

WalkthroughWriter walkthrough_write_text, walkthrough_write_json, walkthrough_write_obj, walkthrough_write_svg;

#endif
