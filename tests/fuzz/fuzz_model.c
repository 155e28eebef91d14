/* Target: a model of any format, by its first bytes; the object has its own material. */
#include "fuzz.h"

#include "reader/scene_model.h"

#include <string.h>

int fuzz_model(const uint8_t *data, size_t size)
{
    static Error error;
    const char *path = fuzz_file(FUZZ_MODEL, data, size);
    error.kind = ERROR_NONE;
    error.text[0] = '\0';
    Scene scene = {
        .camera = {.position = {0.3, 0.2, 5}, .look_at = {0, 0, 0}, .up = {0, 1, 0}},
        .screen = {.columns = 3, .rows = 2, .distance = 1, .width = 2},
        .shading = {.max_bounces = 2},
        .grid = 1,
    };
    SceneBuild build = {.scene = &scene, .error = &error};
    SceneBuildObject object = {.transform = transform_identity(), .split = size % 2 == 0};
    REQUIRE(scene_build_material(&build, (Material){.name = "own", .ambient = {1, 1, 1}}) == 0);
    REQUIRE(names_add(&build.materials, scene.materials[0].name, 0, &error));
    REQUIRE(scene_build_object(&build, "model", object));
    if (scene_model_read(&build, path)) {
        REQUIRE(error.kind == ERROR_NONE && build.face_count > 0);
        if (scene_build_finish(&build))
            fuzz_check_scene(&scene);
        else
            REQUIRE(build.reason[0]);
    } else
        fuzz_check_error(&error);
    scene_build_free(&build);
    scene_free(&scene);
    return 0;
}
