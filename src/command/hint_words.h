/* Hints in words, for `check` and `render`. */
#ifndef RECTRAY_HINT_WORDS_H
#define RECTRAY_HINT_WORDS_H

#include "scene/hints.h"

typedef struct HintWords {
    char text[512];
} HintWords;

/* One sentence, with the places. */
HintWords hint_words(const Scene *scene, const Hint *hint);

extern const char *const hint_names[HINT_KINDS]; /* for programs */

/* Tells on standard error, in one line, why a picture of one colour may be so. */
bool hint_blank_picture(const Scene *scene, Error *error);

#endif
