/* Whole paths and whole pictures. Tests 17, 18 and 19. */
#include "opencl/opencl.h"
#include "reader/scene_json.h"
#include "scenes.h"
#include "tests.h"
#include "trace/reference.h"
#include "trace/reference_render.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

/* --- Facing mirrors --- */

/* Two mirrors, one unit apart, that add 1 a hit: the colour is the sum of rho^k from k = 0 to n. */
static Scene facing_mirrors(double rho)
{
    Scene scene = scene_empty();
    const Vec3 floor[4] = {{-9, -9, -0.5}, {9, -9, -0.5}, {9, 9, -0.5}, {-9, 9, -0.5}};
    const Vec3 ceiling[4] = {{-9, -9, 0.5}, {-9, 9, 0.5}, {9, 9, 0.5}, {9, -9, 0.5}};
    scene_add(&scene, floor, 4);
    scene_add(&scene, ceiling, 4);
    scene_add_light(&scene, vec3(0.25, 0.125, 0.0625));
    scene.materials[0] = (Material){.ambient = {1, 1, 1}, .reflection = rho};
    scene.camera = (Camera){.position = {0, 0, 0}, .look_at = {0, 0, -1}, .up = {0, 1, 0}};
    return scene;
}

void test_mirrors(Suite *suite)
{
    static const double limits[METHOD_COUNT] = {-1, 1e-4, 1e-6, 1e-6}, rhos[] = {0.5, 0.9, 0.99};
    const double ray[6] = {0, 0, 0, 0, 0, -1};
    for (int r = 0; r < 3; r++) {
        double worst[METHOD_COUNT] = {0};
        Scene scene = facing_mirrors(rhos[r]);
        suite_row(suite, "reflection %g, 1 to 64 bounces: relative error", rhos[r]);
        for (int bounces = 1; bounces <= 64; bounces++) {
            double expected = (1 - pow(rhos[r], bounces + 1)) / (1 - rhos[r]);
            scene.shading.max_bounces = bounces;
            suite_load(suite, &scene);
            for (Method method = KERNEL_FLOAT; method < METHOD_COUNT; method++) {
                if (!method_is_here(suite, method))
                    continue;
                double colour[3];
                RenderReport report = {0};
                const Tracer tracer = {.scene = &scene, .report = &report};
                if (method == REFERENCE)
                    vec3_put(colour, reference_pixel(&tracer, 0, 0));
                else
                    probe_colours(&suite->probes[method == KERNEL_DOUBLE], ray, 1, colour);
                worst[method] = fmax(worst[method], fabs(colour[0] - expected) / expected);
            }
        }
        for (Method method = KERNEL_FLOAT; method < METHOD_COUNT; method++)
            suite_measure(suite, method, 64, worst[method], limits[method]);
        scene_free(&scene);
    }
}

/* --- Pictures --- */

typedef struct Picture {
    unsigned char *rgb;
    int columns;
} Picture;

static bool keep_band(void *user, int first_row, int rows, const unsigned char *rgb, const RenderReport *so_far,
                      Error *error)
{
    (void)so_far, (void)error;
    Picture *picture = user;
    size_t row = (size_t)picture->columns * 3;
    memcpy(picture->rgb + (size_t)first_row * row, rgb, (size_t)rows * row);
    return true;
}

static Picture render(const Scene *scene, Method method)
{
    Picture picture = {malloc((size_t)scene->screen.columns * (size_t)scene->screen.rows * 3), scene->screen.columns};
    RenderSettings settings = {.precision = method == KERNEL_FLOAT ? PRECISION_FLOAT : PRECISION_DOUBLE, .device = -1};
    RenderReport report;
    Error error = {0};
    BandSink sink = {keep_band, &picture};
    bool ok = method == REFERENCE ? reference_render(scene, &settings, sink, &report, &error)
                                  : opencl_render(scene, &settings, sink, &report, &error);
    stop_unless(ok, &error);
    return picture;
}

/* Pixels of which a channel differs by more than `most`. */
static long differing(const Scene *scene, Picture a, Picture b, int most)
{
    long count = 0, pixels = (long)scene->screen.columns * scene->screen.rows;
    for (long i = 0; i < pixels; i++) {
        bool differs = false;
        for (int k = 0; k < 3; k++)
            differs = differs || abs(a.rgb[3 * i + k] - b.rgb[3 * i + k]) > most;
        count += differs;
    }
    return count;
}

static void count_pixels(Suite *suite, Method method, const Scene *scene, long wrong)
{
    suite_rays(suite, method, (long)scene->screen.columns * scene->screen.rows);
    for (long i = 0; i < wrong; i++)
        suite_fail(suite, method, NULL, "pixels differ, %ld in all", wrong);
}

static void load(Scene *scene, const char *path)
{
    Error error = {0};
    stop_unless(scene_load(scene, path, &error), &error);
}

/* --- A scene elsewhere --- */

static void write_moved(const char *path, Vec3 by)
{
    FILE *file = fopen(path, "w");
    if (!file)
        exit(3);
    fprintf(file, "{\"camera\": {\"position\": [%.17g, %.17g, %.17g], \"look_at\": [%.17g, %.17g, %.17g]},\n",
            2.5 + by.x, 2 + by.y, 6 + by.z, by.x, by.y, by.z);
    fprintf(file,
            "\"screen\": {\"columns\": 96, \"rows\": 72},\n\"lights\": [{\"position\": [%.17g, %.17g, %.17g]}],\n",
            4 + by.x, 5 + by.y, 3 + by.z);
    fprintf(
        file,
        "\"materials\": {\"m\": {\"ambient\": [0.1, 0.1, 0.2], \"diffuse\": [0.6, 0.5, 0.4], \"specular\": [1, 1, 1],"
        " \"shininess\": 40, \"reflection\": 0.4}},\n\"objects\": [\n");
    fprintf(file,
            "{\"material\": \"m\", \"vertices\": [[-4, -1, -4], [4, -1, -4], [4, -1, 4], [-4, -1, 4]],"
            " \"faces\": [[0, 1, 2, 3]], \"transform\": [{\"translate\": [%.17g, %.17g, %.17g]}]},\n",
            by.x, by.y, by.z);
    fprintf(file,
            "{\"material\": \"m\", \"box\": {\"min\": [-1, -1, -1], \"max\": [1, 1, 1]}, \"transform\": ["
            "{\"rotate\": {\"axis\": [0, 1, 0], \"degrees\": 90}}, {\"scale\": 0.75},"
            " {\"translate\": [%.17g, %.17g, %.17g]}]}\n]}\n",
            by.x, by.y, by.z);
    fclose(file);
}

void test_translation(Suite *suite)
{
    const Vec3 moves[] = {{1e6, 0, 0}, {1e6, -1e6, 1e6}};
    char path[64];
    snprintf(path, sizeof path, "build/stress-moved-%ld.json", (long)getpid());
    Scene home;
    write_moved(path, vec3(0, 0, 0));
    load(&home, path);
    suite->scene = &home;
    for (int i = 0; i < 2; i++) {
        Scene away;
        write_moved(path, moves[i]);
        load(&away, path);
        suite_row(suite, "moved by %g, %g, %g", moves[i].x, moves[i].y, moves[i].z);
        for (Method method = KERNEL_FLOAT; method < METHOD_COUNT; method++) {
            if (!method_is_here(suite, method))
                continue;
            Picture here = render(&home, method), there = render(&away, method);
            count_pixels(suite, method, &home, differing(&home, here, there, 0));
            free(here.rgb);
            free(there.rgb);
        }
        scene_free(&away);
    }
    scene_free(&home);
    remove(path);
}

void test_pictures(Suite *suite)
{
    static const char *const paths[] = {"scenes/cornell.json", "scenes/original.json", "scenes/gallery.json"};
    for (int i = 0; i < 3; i++) {
        Scene scene;
        load(&scene, paths[i]);
        int side = suite->scale < 0.1 ? 48 : 192;
        scene.screen.columns = scene.screen.rows = side;
        scene.grid = 1;
        scene.adaptive = false;
        suite->scene = &scene;
        suite_row(suite, "%s, %d x %d", paths[i], side, side);
        Picture expected = render(&scene, REFERENCE);
        for (Method method = KERNEL_FLOAT; method <= KERNEL_DOUBLE; method++) {
            if (!method_is_here(suite, method))
                continue;
            Picture picture = render(&scene, method);
            count_pixels(suite, method, &scene, differing(&scene, picture, expected, method == KERNEL_FLOAT));
            free(picture.rgb);
        }
        free(expected.rgb);
        scene_free(&scene);
    }
}
