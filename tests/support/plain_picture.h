/* Pictures of the plain kernel beside those of the reference, of every scene in scenes/, scenes/lessons/ and
 * tests/scenes/. */
#ifndef RECTRAY_TESTS_PLAIN_PICTURE_H
#define RECTRAY_TESTS_PLAIN_PICTURE_H

#include "scene/scene.h"
#include "trace/render.h"

/* Rich in everything, for what needs one scene only. */
#define RICH_SCENE "tests/scenes/many_lights.json"

typedef struct Picture {
    int columns, rows;
    unsigned char *rgb; /* the test frees it */
    RenderReport report;
} Picture;

/* Renders on the default device, or fails the test. */
Picture picture_render(const Scene *scene, Backend backend, RenderSettings settings);

/* A sink for bands that puts them into the Picture `user`. */
bool picture_take_band(void *user, int first_row, int rows, const unsigned char *rgb, const RenderReport *so_far,
                       Error *error);

/* Settings of the plain kernel, with the usual shift. */
RenderSettings plain_settings(Precision precision, AccelKind accel, Arithmetic arithmetic);

/* The largest difference of a pixel's three channels, in steps of 1/255. */
int pixel_difference(const Picture *a, const Picture *b, int pixel);

/* What to run to see the pixel; the next call overwrites it. */
const char *picture_describe(const char *path, const Picture *picture, const RenderSettings *settings, int pixel);

/* Every pixel, and all that both count. */
void assert_same_picture(const char *path, const Picture *expected, const Picture *picture,
                         const RenderSettings *settings);

/* A scene to be freed, in its own size where that is small, for some are made for it; without adaptive sampling. */
Scene load_small(const char *path);

void for_each_scene(void (*test)(const char *path, const Scene *scene));

#endif
