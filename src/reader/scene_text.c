/* The text of a scene, taken in bulk or through its tree of values. */
#include "reader/scene_text.h"

#include "base/number.h"
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

static bool try_bulk(Scene *scene, const char *path, const char *text, long length, SceneBulk *bulk, Error *error)
{
    Json json;
    char *rest = text_without(text, length, bulk->objects, error);
    return rest && json_take(&json, path, rest, length - (bulk->objects.end - bulk->objects.begin), error) &&
           scene_values_read(scene, &json, bulk);
}

/* The objects straight from the text, all else through the tree: at once, and if a face is not accepted as it is, face
 * by face. False, with or without an error, where that fails. */
static bool load_bulk(Scene *scene, const char *path, const char *text, long length, Error *error)
{
    SceneBulk bulk = {.one_by_one = false};
    if (!json_bulk_find(text, "objects", &bulk.objects))
        return false;
    if (try_bulk(scene, path, text, length, &bulk, error))
        return true;
    bulk.one_by_one = true;
    return bulk.has_fault && !error->kind && try_bulk(scene, path, text, length, &bulk, error);
}

enum { LONG_TEXT = 1 << 16 }; /* bytes, from which on the table of number_prepare saves more time than it takes */

bool scene_text_read(SceneWay way, Scene *scene, const char *path, char *text, long length, Error *error)
{
    Json json;
    Error reason = {.kind = ERROR_NONE};
    if (length >= LONG_TEXT)
        number_prepare();
    bool in_bulk = way != SCENE_WAY_TREE && load_bulk(scene, path, text, length, &reason);
    if (in_bulk || way == SCENE_WAY_BULK || reason.kind == ERROR_SYSTEM) {
        free(text);
        return in_bulk || (reason.kind && error_set(error, reason.kind, "%s", reason.text));
    }
    return json_take(&json, path, text, length, error) && scene_values_read(scene, &json, NULL);
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
