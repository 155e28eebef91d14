/* Every kind of note on a scene and its models. To add one: its name here, its line in note_kinds.c, its row in
 * docs/scene-format.md (tests/recipes_test.py asks for it), and scene_build_note where it is found. */
#ifndef RECTRAY_NOTE_KINDS_H
#define RECTRAY_NOTE_KINDS_H

#include "base/notes.h"

typedef enum NoteName {
    NOTE_LINES, /* of a model: l */
    NOTE_NAMES, /* how many there are */
} NoteName;

extern const NoteKind note_kinds[NOTE_NAMES];

#endif
