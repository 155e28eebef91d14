/* Target: the scene loader, with a model and a library. */
#include "fuzz.h"

#include "reader/scene_json.h"

#include <stdlib.h>
#include <string.h>

/* Through the tree of values alone the text has the same verdict, message and number of faces. */
static void check_other_way(const char *text, long length, const Scene *scene, const Error *error)
{
    static Error other_error;
    Scene other;
    other_error.kind = ERROR_NONE;
    other_error.text[0] = '\0';
    scene_parse_by(SCENE_WAY_TREE, &other, "/proc/self/fd/scene.json", text, length, &other_error);
    REQUIRE(other_error.kind == error->kind && strcmp(other_error.text, error->text) == 0);
    REQUIRE(other.face_count == scene->face_count);
    REQUIRE(other.face_count == 0 ||
            memcmp(other.faces, scene->faces, (size_t)other.face_count * sizeof *other.faces) == 0);
    scene_free(&other);
}

/* Some frame of a scene that moves; there may be no such frame. */
static void check_frame(const char *text, long length)
{
    static Error error;
    Scene scene;
    char *copy = malloc((size_t)length + 1);
    REQUIRE(copy);
    memcpy(copy, text, (size_t)length);
    copy[length] = '\0';
    error.kind = ERROR_NONE;
    error.text[0] = '\0';
    SceneEdits edits = {.frame = (int)(length % 7), .has_frame = true};
    if (scene_take_edited(&scene, "/proc/self/fd/scene.json", copy, edits, &error)) {
        fuzz_check_scene(&scene);
        scene_free(&scene);
    } else
        fuzz_check_error(&error);
}

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
    bool good = scene_parse(&scene, "/proc/self/fd/scene.json", (const char *)text, (long)length, &error);
    check_other_way((const char *)text, (long)length, &scene, &error);
    check_frame((const char *)text, (long)length);
    if (good) {
        REQUIRE(error.kind == ERROR_NONE);
        fuzz_check_scene(&scene);
        scene_free(&scene);
    } else {
        fuzz_check_error(&error);
        REQUIRE(!scene.faces && !scene.planes && !scene.lights && !scene.materials && !scene.objects);
    }
    return 0;
}
