/* What is odd about a valid scene: it can be rendered, but the picture will hardly be the one that was meant. Hints are
 * no errors, and the search for them may miss some. To add one, see docs/architecture.md. */
#ifndef RECTRAY_HINT_H
#define RECTRAY_HINT_H

#include "scene/scene.h"

typedef enum HintKind {
    HINT_SAME_PLANE,   /* faces `first` and `second`, as traced, overlap in one plane; so do `count` pairs in all */
    HINT_COLOUR,       /* material `first` has a colour as if 255 were full strength; -1: the background */
    HINT_LIGHT_IN_BOX, /* light `first` is in the box that object `second` is, the camera outside */
    HINT_LIGHT_BEHIND, /* light `first` is behind every face that the camera sees the other side of */
    HINT_NO_FACE_SEEN, /* no ray from the camera can hit a face */
    HINT_BLACK,        /* every pixel is black: `first` is a HintBlack */
    HINT_KINDS
} HintKind;

typedef enum HintBlack { BLACK_NO_FACE_SEEN, BLACK_NO_LIGHT, BLACK_NO_COLOUR, BLACK_LIGHTS_HIDDEN } HintBlack;

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

/* Is the object a closed box of six two-sided quads? */
bool hint_is_box(const Scene *scene, int object);

/* Is the point inside the box that the object is? */
bool hint_is_in_box(const Scene *scene, int object, Vec3 point);

#endif
