/* What all parts of the walkthrough as text share: the state of the writer, headings, rows. */
#ifndef RECTRAY_WALKTHROUGH_TEXT_ROWS_H
#define RECTRAY_WALKTHROUGH_TEXT_ROWS_H

#include "walkthrough/ink.h"
#include "walkthrough/rounding.h"
#include "walkthrough/walkthrough.h"
#include "walkthrough/walkthrough_step.h"
#include "walkthrough/walkthrough_words.h"

typedef struct WalkthroughText {
    Ink ink;
    const Walkthrough *walk;
    const WalkthroughStepListener *listener; /* NULL: nobody listens */
    const Rounding *rounding;                /* NULL: the arithmetic is exact */
    WalkthroughPlace place;
    int step;       /* number of the last step's heading */
    int digits;     /* of positions: more than 6 in a scene far from the origin */
    double weight;  /* of the last hit */
    bool rows_told; /* the heading of the table of faces was printed */
} WalkthroughText;

/* Begins the text; `digits` is the least number of digits of positions. */
WalkthroughText walkthrough_text_begin(FILE *out, const Walkthrough *walk, WalkthroughStyle style, int digits);

/* "Step 3. ...", numbered. */
void walkthrough_text_step(WalkthroughText *text, WalkthroughStepKind kind, const char *title);

/* A row that shows a position in the scene file's coordinates. */
InkRow walkthrough_text_place_row(const WalkthroughText *text, InkText label, Vec3 position);

#endif
