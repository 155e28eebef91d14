/* Writes the page with a user's own scene in it: `rectray explore`. The page's parts are inside the program where `make
 * page` built them before it (page.mk); all that is added here is the scene, its models and their libraries. */
#ifndef RECTRAY_EXPLORE_H
#define RECTRAY_EXPLORE_H

#include "base/error.h"

#include <stdio.h>

/* The page without scenes, and its length; NULL where the program was built without it. */
extern const char *const page_template;
extern const long page_template_length;

/* Of the scene and its models: more would make a page that browsers open slowly or not at all. */
enum { EXPLORE_MAX_BYTES = 20 * 1024 * 1024 };

/* What the page shows first; 0 as the scene says. */
typedef struct ExploreWishes {
    int columns, rows, grid;
    bool pixel_given;
    int column, row;
} ExploreWishes;

/* Whether the program carries the page; else the error says how it comes in. */
bool explore_check(Error *error);

/* Writes the page. The scene has been read without an error. */
bool explore_write(FILE *out, const char *scene_path, const ExploreWishes *wishes, Error *error);

#endif
