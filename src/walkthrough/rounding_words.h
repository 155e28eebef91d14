/* Why the textbook's path and the exact one part, in a sentence each. */
#ifndef RECTRAY_ROUNDING_WORDS_H
#define RECTRAY_ROUNDING_WORDS_H

#include "walkthrough/ink.h"
#include "walkthrough/rounding.h"

/* What a length without a sign says: "3e-06", in two digits. */
InkText rounding_size(double x);

/* "floor/0"; "no face" for -1. */
InkText rounding_face(const Rounding *rounding, int face);

/* At that place: what textbook arithmetic finds, and what is exactly so. */
InkText rounding_textbook_words(const Rounding *rounding, RoundingPart part);
InkText rounding_exact_words(const Rounding *rounding, RoundingPart part);

#endif
