/* The parts of the walkthrough as text, shared out to five files: the path, the search for faces,
 * the hits, the lights, the sum. */
#ifndef RECTRAY_WALKTHROUGH_TEXT_H
#define RECTRAY_WALKTHROUGH_TEXT_H

#include "walkthrough/ink.h"
#include "walkthrough/walkthrough.h"

typedef struct TextWalk {
    Ink ink;
    const Walkthrough *walk;
    WalkPlace place;
    int step;       /* number of the last step's heading */
    int digits;     /* of positions: more than 6 in a scene far from the origin */
    double weight;  /* of the last hit */
    bool rows_told; /* the heading of the table of faces was printed */
} TextWalk;

/* "Step 3. ...", numbered. */
void text_step(TextWalk *text, const char *title);

/* A row that shows a position in the scene file's coordinates. */
InkRow text_place_row(const TextWalk *text, InkText label, Vec3 position);

InkRow text_row(InkText label, Vec3 v);

/* "floor/2": the face's object, and its number in it. */
InkText text_face(const Scene *scene, int face, int columns);

/* "+", "-" or "0", in its colour. */
InkText text_sign(const Ink *ink, int sign);

/* --- walkthrough_text_search.c: EVENT_TALLY, EVENT_NODE, EVENT_FACE and EVENT_OCCLUDER --- */

void text_tally(TextWalk *text, const Event *event);
void text_node(TextWalk *text, const Event *event);
void text_face_tested(TextWalk *text, const Event *event);
void text_occluder_tested(TextWalk *text, const Event *event);

/* --- walkthrough_text_hit.c: EVENT_HIT --- */

void text_hit(TextWalk *text, const Event *event);

/* --- walkthrough_text_light.c: EVENT_LIGHT, EVENT_LIGHT_END, EVENT_TERMS --- */

void text_light(TextWalk *text, const Event *event);
void text_light_end(TextWalk *text, const Event *event);
void text_terms(TextWalk *text, const Event *event);

/* --- walkthrough_text_sum.c: EVENT_PATH_END, EVENT_PIXEL --- */

void text_path_end(TextWalk *text, const Event *event);
void text_pixel(TextWalk *text, const Event *event);

#endif
