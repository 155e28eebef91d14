/* The text of a scene, taken in bulk or through its tree of values. */
#include "reader/scene_text.h"

#include "base/number.h"
#include "reader/scene_cuts.h"
#include "reader/scene_values.h"

#include <stdlib.h>
#include <string.h>

/* The text without what the span has of it. NULL without memory. */
static char *text_without(const char *text, long length, JsonSpan span, Error *error)
{
    size_t before = (size_t)(span.begin - text), after = (size_t)(text + length - span.end);
    char *rest = malloc(before + after + 1);
    if (!rest) {
        error_memory(error, "a scene");
        return NULL;
    }
    memcpy(rest, text, before);
    memcpy(rest + before, span.end, after + 1);
    return rest;
}

/* The objects straight from the text, all else through the tree. False, with or without an error, where that fails. */
static bool load_bulk(Scene *scene, const char *path, const char *text, long length, JsonSpan objects, Error *error)
{
    Json json;
    char *rest = text_without(text, length, objects, error);
    return rest && json_take(&json, path, rest, length - (objects.end - objects.begin), error) &&
           scene_values_read(scene, &json, &objects);
}

/* Everything through the tree, but for the vertices and faces of the objects. Takes over the text. */
static bool load_cut(Scene *scene, const char *path, char *text, long length, JsonSpan objects, Error *error)
{
    Json json;
    JsonCuts cuts;
    if (scene_cuts_find(objects, &cuts, error))
        return json_take_cut(&json, path, text, length, cuts, error) && scene_values_read(scene, &json, NULL);
    free(text);
    return false;
}

enum { LONG_TEXT = 1 << 16 }; /* bytes, from which on the table of number_prepare saves more time than it takes */

bool scene_text_read(SceneWay way, Scene *scene, const char *path, char *text, long length, Error *error)
{
    Error reason = {.kind = ERROR_NONE};
    JsonSpan objects = {text, text};
    if (length >= LONG_TEXT)
        number_prepare();
    bool found = way != SCENE_WAY_TREE && json_bulk_find(text, "objects", &objects);
    bool in_bulk = found && load_bulk(scene, path, text, length, objects, &reason);
    if (in_bulk || way == SCENE_WAY_BULK || reason.kind == ERROR_SYSTEM) {
        free(text);
        return in_bulk || (reason.kind && error_set(error, reason.kind, "%s", reason.text));
    }
    return load_cut(scene, path, text, length, objects, error);
}

bool scene_text_move(Scene *scene, const char *path, char *text, Error *error)
{
    Json json;
    JsonSpan objects;
    long length = (long)strlen(text);
    char *rest = json_bulk_find(text, "objects", &objects) ? text_without(text, length, objects, error) : text;
    if (rest != text)
        free(text);
    return rest && json_take(&json, path, rest, (long)strlen(rest), error) && scene_values_move(scene, &json);
}
