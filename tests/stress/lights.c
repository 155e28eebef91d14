/* A light where no light should be. Test 11. */
#include "reference.h"
#include "scenes.h"
#include "tests.h"

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
