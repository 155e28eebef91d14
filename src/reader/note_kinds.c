/* Every kind of note on a scene and its models. */
#include "reader/note_kinds.h"

const NoteKind note_kinds[NOTE_NAMES] = {
    [NOTE_LINES] = {"lines", "a line without width is left out", "lines without width are left out", NULL},
};
