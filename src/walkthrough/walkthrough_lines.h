/* The walkthrough as lines in space, for the formats that draw it: rays, shadow rays, normals, shifted points. */
#ifndef RECTRAY_WALKTHROUGH_LINES_H
#define RECTRAY_WALKTHROUGH_LINES_H

#include "walkthrough/walkthrough.h"

typedef enum WalkthroughLineKind {
    LINE_PRIMARY,   /* from the camera to the first hit, or to nowhere */
    LINE_REFLECTED, /* from a mirror to the next hit, or to nowhere */
    LINE_SHADOW,    /* from a shifted point to a light that reaches it */
    LINE_BLOCKED,   /* to a light that does not, since a face is between */
    LINE_NORMAL,    /* at a hit, on the side of the ray */
    LINE_SHIFT,     /* from a hit to its shifted point: far too short to be seen */
} WalkthroughLineKind;

typedef struct WalkthroughLine {
    WalkthroughLineKind kind;
    Vec3 from, to; /* as in the scene file */
    Vec3 stop;     /* of a blocked line: where the face stands */
    int hit;       /* the k of Pk: where the line ends for rays, where it begins for the others */
    int light;     /* of a shadow ray */
    int face;      /* hit, or in the way; -1: none */
    bool leaves;   /* the ray hits nothing: `to` is some point on it */
} WalkthroughLine;

/* Calls `draw` for every line of the told sample, in the order of the events. */
void walkthrough_lines(const Walkthrough *walk, void (*draw)(void *user, const WalkthroughLine *line), void *user);

#endif
