/* The scene file on its way to a Scene: read, edited, and of a scene that moves one frame. */
#include "reader/scene_json.h"

#include "base/text.h"
#include "reader/scene_animation.h"
#include "json/json_edit.h"
#include "json/json_scan.h"

#include <stdlib.h>
#include <string.h>

static const SceneEdits no_edits = {.count = 0};

/* Takes over the text and returns that of the frame; of a scene that does not move, the text itself. */
static char *choose_frame(const char *name, char *text, SceneEdits edits, Error *error)
{
    SceneAnimation animation;
    int frame = edits.has_frame ? edits.frame : 0;
    if (!scene_animation_is_in(text)) {
        if (!edits.has_frame)
            return text;
        free(text);
        error_set(error, ERROR_USAGE, "there is no frame %d: %s has no \"animation\"", frame, name);
        return NULL;
    }
    if (!scene_animation_open(&animation, name, text, error))
        return NULL;
    char *result = NULL;
    if (frame < animation.frames)
        result = scene_animation_frame(&animation, frame, error);
    else
        error_set(error, ERROR_USAGE, "there is no frame %d: those of %s are 0 to %d", frame, name,
                  animation.frames - 1);
    scene_animation_free(&animation);
    return result;
}

/* A text on the heap that is to be read as `name`. */
typedef struct SceneText {
    const char *name;
    char *text;
    long length;
    bool moves; /* it is a frame of an animation */
} SceneText;

/* Makes the text that which is to be read. One that is no JSON stays: its reader tells why. False, with the text freed,
 * where an edit or the choice of the frame fails. */
static bool edit(SceneText *scene, SceneEdits edits, Error *error)
{
    bool moves = scene_animation_is_in(scene->text);
    if ((edits.count == 0 && !edits.has_frame && !moves) || json_scan(scene->text, scene->length).place)
        return true;
    char *text = scene_edit_text(scene->text, edits, SCENE_EDIT_ANIMATION, error);
    text = text ? choose_frame(scene->name, text, edits, error) : NULL;
    text = text ? scene_edit_text(text, edits, SCENE_EDIT_FRAME, error) : NULL;
    *scene = (SceneText){scene->name, text, text ? (long)strlen(text) : 0, moves};
    return text != NULL;
}

/* Takes over the text. */
static bool load_edited(SceneWay way, Scene *scene, SceneText text, SceneEdits edits, Error *error)
{
    Error reason = {.kind = ERROR_NONE};
    return edit(&text, edits, error) && (scene_text_read(way, scene, text.name, text.text, text.length, &reason) ||
                                         scene_edit_fail(edits, text.moves, &reason, error));
}

/* scene->text is NULL on failure. */
static bool read_text(SceneText *scene, const char *path, Error *error)
{
    *scene = (SceneText){.name = text_input_name(path)};
    scene->text = text_read_input(path, JSON_MAX_BYTES, &scene->length, error);
    return scene->text != NULL;
}

bool scene_load_edited(Scene *scene, const char *path, SceneEdits edits, Error *error)
{
    SceneText text;
    *scene = (Scene){0};
    return read_text(&text, path, error) && load_edited(SCENE_WAY_ANY, scene, text, edits, error);
}

bool scene_take_edited(Scene *scene, const char *name, char *text, SceneEdits edits, Error *error)
{
    *scene = (Scene){0};
    return load_edited(SCENE_WAY_ANY, scene, (SceneText){name, text, (long)strlen(text), false}, edits, error);
}

char *scene_frame_text(const char *path, SceneEdits edits, Error *error)
{
    SceneText text;
    Scene scene = {0};
    Error reason = {.kind = ERROR_NONE};
    if (!read_text(&text, path, error) || !edit(&text, edits, error))
        return NULL;
    char *rest = json_without(text.text, "animation");
    if (scene_text_read(SCENE_WAY_ANY, &scene, text.name, text.text, text.length, &reason) && rest) {
        scene_free(&scene);
        return rest;
    }
    scene_free(&scene);
    free(rest);
    if (reason.kind == ERROR_NONE)
        error_memory(&reason, "a frame");
    scene_edit_fail(edits, text.moves, &reason, error);
    return NULL;
}

bool scene_load(Scene *scene, const char *path, Error *error)
{
    return scene_load_edited(scene, path, no_edits, error);
}

bool scene_parse(Scene *scene, const char *path, const char *text, long length, Error *error)
{
    return scene_parse_by(SCENE_WAY_ANY, scene, path, text, length, error);
}

bool scene_parse_by(SceneWay way, Scene *scene, const char *path, const char *text, long length, Error *error)
{
    *scene = (Scene){0};
    char *copy = malloc((size_t)length + 1);
    if (!copy)
        return error_memory(error, path);
    memcpy(copy, text, (size_t)length);
    copy[length] = '\0';
    return load_edited(way, scene, (SceneText){path, copy, length, false}, no_edits, error);
}
