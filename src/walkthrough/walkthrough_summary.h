/* A walkthrough in short: the path, what each hit adds, which lights reach it, why the path ended, the bytes. It is
 * made from the recorded events. The text and the JSON begin with it. */
#ifndef RECTRAY_WALKTHROUGH_SUMMARY_H
#define RECTRAY_WALKTHROUGH_SUMMARY_H

#include "walkthrough/ink.h"
#include "walkthrough/walkthrough.h"

enum { SUMMARY_LINES = 20 }; /* the text has no more of them */

typedef struct SummaryLight {
    int light;
    LightVerdict verdict;
    int blocker; /* a face, of LIGHT_BLOCKED; else -1 */
} SummaryLight;

typedef struct SummaryHit {
    int face;
    double distance; /* from where the ray started */
    double weight;
    Vec3 illumination, contribution;
    const SummaryLight *lights; /* one for each light of the scene */
} SummaryHit;

typedef struct Summary {
    const Walkthrough *walk; /* borrowed */
    SummaryHit *hits;        /* of the sample that is told: P1, P2, ... */
    int hit_count;
    SummaryLight *lights; /* of all hits */
    bool missed;          /* the path left the scene: the background shone in */
    double background_weight;
    Vec3 background; /* what it adds */
    InkText end;     /* why the path ended, a sentence without its full stop */
    Vec3 colour;     /* of the sample */
    int samples;
    unsigned char rgb[3];
} Summary;

/* Fails only for want of memory. */
bool summary_make(Summary *summary, const Walkthrough *walk, Error *error);
void summary_free(Summary *summary);

/* At most SUMMARY_LINES lines; the last one is "Pixel (3, 2) = (97, 74, 97)". */
void summary_write_text(const Ink *ink, const Summary *summary);

#endif
