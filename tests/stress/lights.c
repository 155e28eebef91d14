/* A light where no light should be, and what a highlight is made of. Tests 11 and 20. */
#include "scenes.h"
#include "tests.h"
#include "trace/reference.h"

#include <math.h>

/* A white square in the plane z = 0, looked at from (0, 0, 3) along -z. */
static void light_at(Suite *suite, const char *where, Vec3 position, bool lit)
{
    Scene scene = scene_empty();
    const Vec3 square[4] = {{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}};
    scene_add(&scene, square, 4);
    scene_add_light(&scene, position);
    scene.materials[0].ambient = vec3(1, 1, 1); /* of a light that does not reach the point, not even this counts */
    scene.camera.position = vec3(0, 0, 3);
    suite_load(suite, &scene);
    suite_row(suite, "light %s", where);
    const double ray[6] = {0, 0, 3, 0, 0, -1};
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
        suite_rays(suite, method, 1);
        for (int k = 0; k < 3; k++)
            if (!isfinite(colour[k]) || colour[k] < 0 || (colour[k] > 0) != lit) {
                suite_fail(suite, method, ray, "colour %g", colour[k]);
                break;
            }
    }
    scene_free(&scene);
}

void test_light_on_face(Suite *suite)
{
    light_at(suite, "on the face", vec3(0.5, 0.25, 0), false);
    light_at(suite, "on its edge", vec3(1, 0.25, 0), false);
    light_at(suite, "on its corner", vec3(1, 1, 0), false);
    light_at(suite, "in its plane, beside it", vec3(3, 0, 0), false);
    light_at(suite, "at the hit point", vec3(0, 0, 0), false);
    light_at(suite, "behind it", vec3(0, 0, -1), false);
    light_at(suite, "behind it by 2^-40", vec3(0.5, 0, -0x1p-40), false);
    light_at(suite, "before it", vec3(0, 0, 1), true);
    light_at(suite, "before it by 2^-20", vec3(0.5, 0, 0x1p-20), true);
    light_at(suite, "at the camera", vec3(0, 0, 3), true);
}

enum { PAIRS = 4096 };

/* The largest error of powers of numbers from 0 to 1, most of them near 1, where a highlight is bright. */
static void powers_to(Suite *suite, double exponent)
{
    suite_row(suite, "to the power %g", exponent);
    const double edges[] = {0, 1, 1 - 0x1p-24, 0.5, 2.0 / 3, 0x1p-126, 0x1p-140};
    enum { EDGES = sizeof edges / sizeof edges[0] };
    static double pairs[2 * PAIRS], powers[PAIRS];
    for (int i = 0; i < PAIRS; i++) {
        double x = random_in(&suite->random, 0, 1);
        pairs[2 * i] = (double)(float)(i < EDGES ? edges[i] : i % 2 ? x : 1 - x / (1 + exponent));
        pairs[2 * i + 1] = (double)(float)exponent;
    }
    for (Method method = KERNEL_FLOAT; method <= KERNEL_DOUBLE; method++) {
        if (!method_is_here(suite, method))
            continue;
        probe_powers(&suite->probes[method == KERNEL_DOUBLE], pairs, PAIRS, powers);
        double most = 0;
        for (int i = 0; i < PAIRS; i++) {
            double error = fabs(powers[i] - pow(pairs[2 * i], pairs[2 * i + 1]));
            most = error <= most ? most : error; /* NaN stays */
        }
        suite_measure(suite, method, PAIRS, most, method == KERNEL_FLOAT ? 0x1p-23 : 0x1p-50);
    }
}

void test_powers(Suite *suite)
{
    Scene scene = scene_empty();
    suite_load(suite, &scene);
    const double exponents[] = {0, 0.25, 1, 2.5, 25, 250, 25000, 1e18};
    for (size_t i = 0; i < sizeof exponents / sizeof exponents[0]; i++)
        powers_to(suite, exponents[i]);
    scene_free(&scene);
}
