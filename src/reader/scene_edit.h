/* Changes of a scene file's text before it is read. */
#ifndef RECTRAY_SCENE_EDIT_H
#define RECTRAY_SCENE_EDIT_H

#include "base/error.h"

/* A value to put into the scene file's text before it is read: json_edit.h. */
typedef struct SceneEdit {
    const char *path, *value;
    const char *origin; /* for messages: the option that asks for it, with its value */
} SceneEdit;

typedef struct SceneEdits {
    const SceneEdit *items;
    int count;
    int frame;      /* of the scene's animation */
    bool has_frame; /* else it is frame 0, and the scene needs no animation */
} SceneEdits;

/* The edits of a scene's animation come before the choice of its frame; all others change the frame. */
typedef enum SceneEditTime { SCENE_EDIT_ANIMATION, SCENE_EDIT_FRAME } SceneEditTime;

/* Takes over the text and returns it with the edits of that time. NULL, with an error that begins with the edit's
 * origin, where one fails. */
char *scene_edit_text(char *text, SceneEdits edits, SceneEditTime time, Error *error);

/* Fills the error with the reason why a scene was not read, and says with which edits, and where it `moves`, as which
 * frame it was. Returns false. */
bool scene_edit_fail(SceneEdits edits, bool moves, const Error *reason, Error *error);

#endif
