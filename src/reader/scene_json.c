/* The scene file as a text: read, edited, and taken in bulk or through its tree of values. */
#include "reader/scene_json.h"

#include "base/number.h"
#include "base/text.h"
#include "reader/scene_values.h"
#include "json/json_edit.h"

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

/* Takes over the text. Where it cannot be read in bulk, all of it goes through the tree, which knows every place: so
 * there is one list of messages, and the first error of a file is the same whatever its size. */
static bool load_text(SceneWay way, Scene *scene, const char *path, char *text, long length, Error *error)
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

/* --- Edits --- */

/* Takes over the text and returns the edited one. NULL where an edit fails. */
static char *apply(char *text, const SceneEdit *edits, int count, Error *error)
{
    for (int i = 0; text && i < count; i++) {
        Error reason = {.kind = ERROR_NONE};
        char *edited = json_edit(text, edits[i].path, edits[i].value, &reason);
        if (!edited)
            error_set(error, reason.kind, "%s: %s", edits[i].origin, reason.text);
        free(text);
        text = edited;
    }
    return text;
}

/* Adds the edits to a message about the scene. */
static bool fail_edited(const SceneEdit *edits, int count, const Error *reason, Error *error)
{
    char list[512] = "";
    for (int i = 0; i < count; i++) {
        size_t used = strlen(list);
        snprintf(list + used, sizeof list - used, " %s", edits[i].origin);
    }
    return error_set(error, reason->kind, count > 0 ? "%s\nread with%s" : "%s%s", reason->text, list);
}

/* Takes over the text. One that is no JSON is not edited: its reader tells why. */
static bool load_edited(Scene *scene, const char *name, char *text, long length, SceneEdits edits, Error *error)
{
    Error reason = {.kind = ERROR_NONE};
    int count = edits.count > 0 && !json_scan(text, length).place ? edits.count : 0;
    if (count > 0) {
        text = apply(text, edits.items, count, error);
        if (!text)
            return false;
        length = (long)strlen(text);
    }
    return load_text(SCENE_WAY_ANY, scene, name, text, length, &reason) ||
           fail_edited(edits.items, count, &reason, error);
}

bool scene_load_edited(Scene *scene, const char *path, SceneEdits edits, Error *error)
{
    long length = 0;
    *scene = (Scene){0};
    char *text = text_read_input(path, JSON_MAX_BYTES, &length, error);
    return text && load_edited(scene, text_input_name(path), text, length, edits, error);
}

bool scene_take_edited(Scene *scene, const char *name, char *text, SceneEdits edits, Error *error)
{
    *scene = (Scene){0};
    return load_edited(scene, name, text, (long)strlen(text), edits, error);
}

bool scene_load(Scene *scene, const char *path, Error *error)
{
    return scene_load_edited(scene, path, (SceneEdits){NULL, 0}, error);
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
    return load_text(way, scene, path, copy, length, error);
}
