/* Every kind of note on a scene and its models. To add one: its name here, its line in note_kinds.c, its row in
 * docs/scene-format.md (tests/recipes_test.py asks for it), and scene_build_note where it is found. */
#ifndef RECTRAY_NOTE_KINDS_H
#define RECTRAY_NOTE_KINDS_H

#include "base/notes.h"

typedef enum NoteName {
    NOTE_LINES,  /* of a model: l */
    NOTE_POINTS, /* p */
    NOTE_CURVES, /* vp, and what makes curves and free-form surfaces */
    NOTE_SMOOTHING,
    NOTE_VERTEX_COLOURS,
    NOTE_DISPLAY,
    NOTE_UNKNOWN, /* also of a library */
    NOTE_LIBRARY_MISSING,
    NOTE_LIBRARY_RENAMED,
    NOTE_MATERIAL_MISSING,
    NOTE_MATERIAL_TWICE, /* of a library, as the rest */
    NOTE_MATERIAL_UNREAD,
    NOTE_VALUE_TWICE,
    NOTE_MIRROR,
    NOTE_ILLUM,
    NOTE_OPACITY,
    NOTE_EMISSION,
    NOTE_PICTURE,
    NOTE_PICTURE_ONLY,
    NOTE_PHYSICAL,
    NOTE_AMBIENT_WHITE,
    NOTE_BENT, /* of a face, as the rest */
    NOTE_NO_AREA,
    NOTE_REPEATED,
    NOTE_FOLDED,
    NOTE_TOO_SMALL,
    NOTE_NAMES, /* how many there are */
} NoteName;

extern const NoteKind note_kinds[NOTE_NAMES];

#endif
