/* Adaptive sampling: is one ray through its centre enough for a pixel? It is where the path of that ray is the path of
 * every ray of the pixel: the same faces, the same lights, and light that changes too evenly over the pixel to matter.
 * Then the ray's colour is the pixel's average; else it gets a lattice of samples. docs/algorithm.md, section 12. */
#ifndef RECTRAY_ADAPTIVE_H
#define RECTRAY_ADAPTIVE_H

#include "trace/beam_query.h"
#include "trace/render.h"

/* What adds less than this to a pixel is left out: an eighth of an output step. */
#define ADAPTIVE_TOLERANCE 0x1p-11

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

/* How many samples each refined pixel gets, where the finest grid is n x n: a power of two, at least 2 n and n^2/4, at
 * most n^2 (n >= 2). */
int adaptive_samples(int n);

/* The samples of a refined pixel are a lattice: of a grid of samples x samples cells sample k has the middle of cell
 * (k, k generator mod samples), so that each column and each row holds one. `samples`: a power of two from 2 to 1024.
 * After Sloan and Joe (1994), Lattice Methods for Multiple Integration. */
int adaptive_generator(int samples);

/* The most that a hit, with all that its mirror shows, can add to a pixel of the scene. */
double adaptive_brightest(const Scene *scene);

/* Judges the pixel whose centre ray took the path. Tests are added to the report. */
AdaptiveVerdict adaptive_judge(const Scene *scene, const Accel *accel, const Path *path, int column, int row,
                               RenderReport *report);

#endif
