/* Adaptive sampling: is one ray through its centre enough for a pixel? It is where the path of that ray is the path of
 * every ray of the pixel: the same faces, the same lights, and light that changes too evenly over the pixel to matter.
 * Then the ray's colour is the pixel's average; else the pixel gets the whole grid. docs/algorithm.md, step 14. Floor 4. */
#ifndef RECTRAY_ADAPTIVE_H
#define RECTRAY_ADAPTIVE_H

#include "beam_query.h"
#include "render.h"

/* What adds less than this to a pixel is left out: an eighth of an output step. */
#define ADAPTIVE_TOLERANCE 0x1p-11

/* Where the samples of a quarter of the grid differ by less than this, they are enough; and those of two quarters. An edge that
 * small leaves a smaller error with fewer samples than a large one with all. */
#define ADAPTIVE_QUARTER_SPREAD (1.0 / 16)
#define ADAPTIVE_HALF_SPREAD (1.0 / 8)

/* The faces that a ray met, in order; a -1 at the end says that it left the scene. */
typedef struct Path {
    int count;
    int faces[SCENE_MAX_BOUNCES + 2];
} Path;

typedef enum AdaptiveReason {
    ADAPTIVE_SAME,      /* nothing changes over the pixel: its centre is enough */
    ADAPTIVE_EDGE,      /* an edge of the face that the centre sees may cross the pixel */
    ADAPTIVE_FACE,      /* another face may */
    ADAPTIVE_SHADOW,    /* the shadow of a face may end within it */
    ADAPTIVE_HIGHLIGHT, /* the light on the face may change unevenly */
} AdaptiveReason;

/* Why a pixel is refined. */
typedef struct AdaptiveVerdict {
    AdaptiveReason reason;
    int hit;   /* which hit of the path it concerns: 0 for the first */
    int face;  /* ADAPTIVE_EDGE: the face that is hit; ADAPTIVE_FACE, _SHADOW: the other one */
    int light; /* ADAPTIVE_SHADOW, _HIGHLIGHT */
} AdaptiveVerdict;

/* A refined pixel's n x n samples are traced in parts. Where n is even and at least 6 they are quarters, one sample of each
 * block of 2 x 2; for any other n all samples are one part. */
int adaptive_parts(int grid);

/* Sample k of a part; with one part they come row by row. */
typedef struct GridPlace {
    int i, j;
} GridPlace;
GridPlace adaptive_sample(int grid, int part, int k);

/* After that many parts, the samples of which differ by at most `spread` in a channel, may the others be left out? */
bool adaptive_is_enough(int parts, double spread);

/* The most that a hit, with all that its mirror shows, can add to a pixel of the scene. */
double adaptive_brightest(const Scene *scene);

/* Judges the pixel whose centre ray took the path. Tests are added to the report. */
AdaptiveVerdict adaptive_judge(const Scene *scene, const Accel *accel, const Path *path, int column, int row,
                               RenderReport *report);

#endif
