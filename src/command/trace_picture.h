/* The picture of a scene, small, for the drawing of `rectray trace`. */
#ifndef RECTRAY_TRACE_PICTURE_H
#define RECTRAY_TRACE_PICTURE_H

#include "walkthrough/walkthrough_formats.h"

enum { TRACE_PICTURE_MAX = 128 }; /* columns and rows; a larger picture is rendered with fewer, 2 x 2 rays for each */

/* Renders it with the reference tracer. Free the picture also after a failure. */
bool trace_picture_make(WalkthroughPicture *picture, const Scene *scene, Error *error);
void trace_picture_free(WalkthroughPicture *picture);

#endif
