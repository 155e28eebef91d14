/* Target: the scene loader, with a model and a library. */
#include "fuzz.h"

#include "reader/scene_json.h"

#include <stdlib.h>
#include <string.h>

int fuzz_scene(const uint8_t *data, size_t size)
{
    static Error error;
    const uint8_t *text = data;
    size_t length = fuzz_cut(&data, &size);
    const uint8_t *model = data;
    size_t model_length = fuzz_cut(&data, &size);
    fuzz_file(FUZZ_MODEL, model, model_length);
    fuzz_file(FUZZ_LIBRARY, data, size);
    Scene scene;
    error.kind = ERROR_NONE;
    error.text[0] = '\0';
    if (scene_parse(&scene, "/proc/self/fd/scene.json", (const char *)text, (long)length, &error)) {
        REQUIRE(error.kind == ERROR_NONE);
        fuzz_check_scene(&scene);
        scene_free(&scene);
    } else {
        fuzz_check_error(&error);
        REQUIRE(!scene.faces && !scene.planes && !scene.lights && !scene.materials && !scene.objects);
    }
    return 0;
}
