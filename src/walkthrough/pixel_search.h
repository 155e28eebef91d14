/* Finds a pixel that shows something, for a user who does not know where to look. */
#ifndef RECTRAY_PIXEL_SEARCH_H
#define RECTRAY_PIXEL_SEARCH_H

#include "base/error.h"
#include "scene/scene.h"

/* What the ray through the pixel's centre must do; all of it. The darkest is that of the picture's colours. */
typedef struct PixelWish {
    const char *face;  /* "floor/5", or "floor": hit this face, or one of this object; NULL: any */
    int blocked_light; /* at the first hit something stands before this light; -1: no wish */
    int mirrors;       /* be reflected so many times at least; 0: no wish */
    bool darkest;      /* have the least light of all that do the rest */
} PixelWish;

/* The pixel in the middle of those that fit, or the darkest. A face is looked for in mirrors where it is not seen
 * directly. A large picture is searched in steps of several pixels, and pixel by pixel where that finds none; from the
 * darkest one the search goes on until no pixel nearby is darker. Fails with an ERROR_USAGE that says what no pixel
 * shows. */
bool pixel_search(const Scene *scene, const PixelWish *wish, int *column, int *row, Error *error);

#endif
