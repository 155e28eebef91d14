/* Pictures of the plain kernel beside those of the reference. */
#include "support/plain_picture.h"

#include "opencl/opencl.h"
#include "reader/scene_json.h"
#include "trace/reference_render.h"

#include "unity.h"

#include <glob.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

bool picture_take_band(void *user, int first_row, int rows, const unsigned char *rgb, const RenderReport *so_far,
                       Error *e)
{
    (void)so_far, (void)e;
    Picture *picture = user;
    size_t row_bytes = (size_t)picture->columns * 3;
    memcpy(picture->rgb + (size_t)first_row * row_bytes, rgb, (size_t)rows * row_bytes);
    return true;
}

Picture picture_render(const Scene *scene, Backend backend, RenderSettings settings)
{
    Picture picture = {.columns = scene->screen.columns, .rows = scene->screen.rows};
    picture.rgb = calloc((size_t)picture.columns * (size_t)picture.rows, 3);
    TEST_ASSERT_NOT_NULL(picture.rgb);
    BandSink sink = {picture_take_band, &picture};
    Error error = {0};
    settings.device = -1;
    bool ok = backend == BACKEND_OPENCL ? opencl_render(scene, &settings, sink, &picture.report, &error)
                                        : reference_render(scene, &settings, sink, &picture.report, &error);
    TEST_ASSERT_TRUE_MESSAGE(ok, error.text);
    return picture;
}

RenderSettings plain_settings(Precision precision, AccelKind accel, Arithmetic arithmetic)
{
    return (RenderSettings){
        .kernel = KERNEL_PLAIN, .precision = precision, .accel = accel, .arithmetic = arithmetic, .shift = SCENE_SHIFT};
}

int pixel_difference(const Picture *a, const Picture *b, int pixel)
{
    int most = 0;
    for (int i = 3 * pixel; i < 3 * pixel + 3; i++)
        most = abs(a->rgb[i] - b->rgb[i]) > most ? abs(a->rgb[i] - b->rgb[i]) : most;
    return most;
}

const char *picture_describe(const char *path, const Picture *picture, const RenderSettings *settings, int pixel)
{
    static char text[512];
    snprintf(text, sizeof text,
             "pixel %d,%d; see: rectray render %s --sampling uniform --size %dx%d --kernel %s --precision %s "
             "--accel %s --arithmetic %s",
             pixel % picture->columns, pixel / picture->columns, path, picture->columns, picture->rows,
             render_kernels[settings->kernel], render_precisions[settings->precision], render_accels[settings->accel],
             render_arithmetics[settings->arithmetic]);
    return text;
}

void assert_same_picture(const char *path, const Picture *expected, const Picture *picture,
                         const RenderSettings *settings)
{
    for (int i = 0; i < expected->columns * expected->rows; i++)
        if (pixel_difference(expected, picture, i) > 0)
            TEST_FAIL_MESSAGE(picture_describe(path, expected, settings, i));
    const RenderReport *a = &expected->report, *b = &picture->report;
    TEST_ASSERT_EQUAL_UINT64_MESSAGE(a->rays.primary, b->rays.primary, path);
    TEST_ASSERT_EQUAL_UINT64_MESSAGE(a->rays.shadow, b->rays.shadow, path);
    TEST_ASSERT_EQUAL_UINT64_MESSAGE(a->rays.reflection, b->rays.reflection, path);
    TEST_ASSERT_EQUAL_UINT64_MESSAGE(a->skipped[SKIP_LIGHT_BEHIND], b->skipped[SKIP_LIGHT_BEHIND], path);
    if (settings->accel == ACCEL_NONE) { /* each tree has its own way */
        TEST_ASSERT_EQUAL_UINT64_MESSAGE(a->face_tests, b->face_tests, path);
        TEST_ASSERT_EQUAL_UINT64_MESSAGE(0, b->box_tests, path);
    }
}

/* --- Scenes --- */

Scene load_small(const char *path)
{
    Scene scene;
    Error error = {0};
    TEST_ASSERT_TRUE_MESSAGE(scene_load(&scene, path, &error), error.text);
    if (scene.screen.columns * scene.screen.rows > 10000) {
        scene.screen.columns = 61;
        scene.screen.rows = 47;
    }
    scene.grid = scene.adaptive ? 1 : scene.grid;
    scene.adaptive = false;
    return scene;
}

void for_each_scene(void (*test)(const char *path, const Scene *scene))
{
    const char *const patterns[] = {"scenes/*.json", "scenes/lessons/*.json", "tests/scenes/*.json"};
    for (size_t p = 0; p < sizeof patterns / sizeof *patterns; p++) {
        glob_t found;
        TEST_ASSERT_EQUAL_INT_MESSAGE(0, glob(patterns[p], 0, NULL, &found), patterns[p]);
        for (size_t i = 0; i < found.gl_pathc; i++) {
            Scene scene = load_small(found.gl_pathv[i]);
            test(found.gl_pathv[i], &scene);
            scene_free(&scene);
        }
        globfree(&found);
    }
}
