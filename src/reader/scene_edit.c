/* Changes of a scene file's text, by the paths of its values. */
#include "reader/scene_edit.h"

#include "json/json_edit.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static bool is_of_animation(const char *path)
{
    static const char *const ways[] = {"animation", "[\"animation\"]"};
    for (int i = 0; i < 2; i++) {
        size_t length = strlen(ways[i]);
        if (strncmp(path, ways[i], length) == 0 && (path[length] == '\0' || strchr(".[", path[length])))
            return true;
    }
    return false;
}

char *scene_edit_text(char *text, SceneEdits edits, SceneEditTime time, Error *error)
{
    for (int i = 0; text && i < edits.count; i++) {
        const SceneEdit *edit = &edits.items[i];
        Error reason = {.kind = ERROR_NONE};
        if (is_of_animation(edit->path) != (time == SCENE_EDIT_ANIMATION))
            continue;
        char *edited = json_edit(text, edit->path, edit->value, &reason);
        if (!edited)
            error_set(error, reason.kind, "%s: %s", edit->origin, reason.text);
        free(text);
        text = edited;
    }
    return text;
}

bool scene_edit_fail(SceneEdits edits, bool moves, const Error *reason, Error *error)
{
    char list[512] = "", frame[64] = "";
    for (int i = 0; i < edits.count; i++) {
        size_t used = strlen(list);
        snprintf(list + used, sizeof list - used, " %s", edits.items[i].origin);
    }
    if (moves)
        snprintf(frame, sizeof frame, "\nread as frame %d", edits.has_frame ? edits.frame : 0);
    return error_set(error, reason->kind, edits.count > 0 ? "%s%s\nread with%s" : "%s%s%s", reason->text, frame, list);
}
