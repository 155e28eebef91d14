/* Target: the OBJ reader, with a material library. The object has its own material where the model's length is odd. */
#include "fuzz.h"

#include "reader/scene_obj.h"

#include <string.h>

int fuzz_obj(const uint8_t *data, size_t size)
{
    static Error error;
    const uint8_t *text = data;
    size_t length = fuzz_cut(&data, &size);
    const char *path = fuzz_file(FUZZ_MODEL, text, length);
    fuzz_file(FUZZ_LIBRARY, data, size);

    error.kind = ERROR_NONE;
    error.text[0] = '\0';
    Scene scene = {
        .camera = {.position = {0.3, 0.2, 5}, .look_at = {0, 0, 0}, .up = {0, 1, 0}},
        .screen = {.columns = 3, .rows = 2, .distance = 1, .width = 2},
        .shading = {.max_bounces = 2},
        .grid = 1,
    };
    SceneBuild build = {.scene = &scene, .error = &error};
    SceneBuildObject object = {
        .transform = transform_identity(), .material = length % 2 ? 0 : -1, .split = length % 4 < 2};
    REQUIRE(scene_build_material(&build, (Material){.name = "own", .ambient = {1, 1, 1}}) == 0);
    REQUIRE(names_add(&build.materials, scene.materials[0].name, 0, &error));
    REQUIRE(scene_build_object(&build, "model", object));
    if (scene_obj_read(&build, path)) {
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
