/* What is odd about a valid scene: it can be rendered, but the picture will hardly be the one that was meant. Hints are
 * no errors, and the search for them may miss some. To add one, see docs/architecture.md. */
#ifndef RECTRAY_HINT_H
#define RECTRAY_HINT_H

#include "scene/scene.h"

typedef enum HintKind {
    HINT_SAME_PLANE,       /* faces `first` and `second`, as traced, overlap in one plane; so do `count` pairs in all */
    HINT_COLOUR,           /* a colour as if 255 were full strength: of `second`, a HintOwner, number `first` */
    HINT_LIGHT_IN_BOX,     /* light `first` is in the closed object `second`, the camera outside */
    HINT_LIGHT_OUT_OF_BOX, /* light `first` is outside the closed object `second`, the camera inside */
    HINT_LIGHT_BEHIND,     /* light `first` is behind every face that the camera sees the other side of */
    HINT_LIGHT_HIDDEN,     /* light `first` reaches none of the points that were tried; face `second` is in its way, or
                              -1: it is behind all of them */
    HINT_TINY,             /* all that is in view is within a row or a column of pixels */
    HINT_NO_FACE_SEEN,     /* no ray from the camera can hit a face; `first` 1: none of those that were tried does */
    HINT_BLACK, /* every pixel is black: `first` is a HintBlack. `second` 0: at least those that were tried */
    HINT_KINDS
} HintKind;

typedef enum HintBlack {
    BLACK_NO_FACE_SEEN,
    BLACK_NO_LIGHT,
    BLACK_LIGHTS_BLACK,
    BLACK_NO_COLOUR,
    BLACK_COLOURS_DIFFER, /* what the lights have, the materials do not reflect */
    BLACK_TOO_DARK,       /* all colours are rounded to 0 */
    BLACK_LIGHTS_HIDDEN,
    BLACK_UNLIT /* so it came out */
} HintBlack;

typedef enum HintOwner { OWNER_BACKGROUND, OWNER_MATERIAL, OWNER_LIGHT } HintOwner;

typedef struct Hint {
    HintKind kind;
    int first, second, count;
} Hint;

typedef struct Hints {
    Hint *list;
    int count, capacity;
} Hints;

bool hint_add(Hints *hints, Hint hint, Error *error);
void hints_free(Hints *hints);

/* Is there a hint of the kind, on this `first`? -1: on any. */
bool hints_have(const Hints *hints, HintKind kind, int first);

/* The colour that a HINT_COLOUR is about, and its key in the scene file. */
typedef struct HintColour {
    const char *key;
    Vec3 colour;
} HintColour;

HintColour hint_colour_of(const Scene *scene, const Hint *hint);

/* Full strength is 1. More than that is hardly meant where picture programs have it: 0 to 255. */
bool hint_looks_like_bytes(HintOwner owner, Vec3 colour);

#endif
