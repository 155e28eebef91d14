/* Reads a scene, and tells its notes. */
#include "command/scene_open.h"

#include "reader/scene_json.h"
#include "reader/stage.h"

#include <stdlib.h>
#include <string.h>

bool scene_open_tell(const Notes *notes, const Options *options, bool every, Error *error)
{
    if (options->strict)
        return notes_refuse(notes, error);
    if (!options->quiet)
        notes_print(notes, stderr, every);
    return true;
}

/* --- Edits --- */

enum { ORIGIN_MAX = 200 }; /* bytes of an option in messages: behind a longer one the reason would be cut off */

/* What an edit needs: three strings in one piece of memory. */
typedef struct EditText {
    char *memory;
    SceneEdit edit;
} EditText;

/* Where the path of "PATH=VALUE" ends: an "=" within ["a key"] is part of it. */
static size_t path_length(const char *value)
{
    const char *at = value;
    while (*at && *at != '=') {
        const char *end = at[0] == '[' && at[1] == '"' ? strstr(at, "\"]") : NULL;
        at = end ? end + 2 : at + 1;
    }
    return (size_t)(at - value);
}

static void write_edit(char *path, char *value, size_t size, const OptionEdit *option)
{
    const char *text = option->value;
    size_t equals = path_length(text);
    if (strcmp(option->option, "set") == 0) {
        snprintf(path, size, "%.*s", (int)equals, text);
        snprintf(value, size, "%s", text[equals] ? text + equals + 1 : "");
    } else if (strcmp(option->option, "light") == 0) {
        snprintf(path, size, "lights[%.*s].position", (int)equals, text);
        snprintf(value, size, "[%s]", text + equals + 1);
    } else {
        const char *key = option->option;
        snprintf(path, size, "camera.%s",
                 strcmp(key, "camera") == 0 ? "position"
                 : strcmp(key, "up") == 0   ? "up"
                                            : "look_at");
        snprintf(value, size, "[%s]", text);
    }
}

static bool make_edit(EditText *made, const OptionEdit *option, Error *error)
{
    size_t size = strlen(option->value) + 64;
    made->memory = malloc(3 * size);
    if (!made->memory)
        return error_memory(error, "a change of the scene");
    char *path = made->memory, *value = path + size, *origin = value + size;
    write_edit(path, value, size, option);
    snprintf(origin, size, "--%s %.*s%s", option->option, ORIGIN_MAX, option->value,
             strlen(option->value) > ORIGIN_MAX ? "..." : "");
    made->edit = (SceneEdit){path, value, origin};
    return true;
}

/* All that the options ask for. Free it also after a failure. */
typedef struct Edits {
    EditText made[EDITS_MAX];
    SceneEdit items[EDITS_MAX];
    SceneEdits list;
} Edits;

static bool make_edits(Edits *edits, const Options *options, Error *error)
{
    edits->list = (SceneEdits){edits->items, 0, options->frame, options->frame_given};
    for (int i = 0; i < options->edit_count; i++) {
        edits->made[i].memory = NULL;
        edits->list.count++;
        if (!make_edit(&edits->made[i], &options->edits[i], error))
            return false;
        edits->items[i] = edits->made[i].edit;
    }
    return true;
}

static void free_edits(Edits *edits)
{
    for (int i = 0; i < edits->list.count; i++)
        free(edits->made[i].memory);
}

/* A model is read as a scene of its own. Its stage has a name without a folder, so that the model's path in it counts
 * from the working directory. */
static bool load(Scene *scene, const char *path, SceneEdits edits, Error *error)
{
    if (!stage_is_model(path))
        return scene_load_edited(scene, path, edits, error);
    char *text = stage_text(path, error);
    return text && scene_take_edited(scene, "stage", text, edits, error);
}

bool scene_open_load(Scene *scene, const Options *options, Error *error)
{
    Edits edits;
    *scene = (Scene){0};
    bool done = make_edits(&edits, options, error) && load(scene, options->operands[0], edits.list, error);
    free_edits(&edits);
    return done;
}

char *scene_open_frame(const Options *options, Error *error)
{
    Edits edits;
    char *text = make_edits(&edits, options, error) ? scene_frame_text(options->operands[0], edits.list, error) : NULL;
    free_edits(&edits);
    return text;
}

bool scene_open_film(OpenFilm *opened, const Options *options, Error *error)
{
    *opened = (OpenFilm){.edits = calloc(1, sizeof *opened->edits)};
    if (!opened->edits)
        return error_memory(error, "a film");
    return make_edits(opened->edits, options, error) &&
           scene_film_open(&opened->film, options->operands[0], opened->edits->list, error);
}

void scene_close_film(OpenFilm *opened)
{
    scene_film_free(&opened->film);
    if (opened->edits)
        free_edits(opened->edits);
    free(opened->edits);
}

bool scene_open(Scene *scene, const Options *options, Error *error)
{
    if (!scene_open_load(scene, options, error))
        return false;
    bool good = scene_open_tell(&scene->notes, options, false, error);
    if (!good)
        scene_free(scene);
    return good;
}
