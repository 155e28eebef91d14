/* The boxes of a tree that the rays of a walkthrough met, for the formats that draw them. */
#ifndef RECTRAY_WALKTHROUGH_BOXES_H
#define RECTRAY_WALKTHROUGH_BOXES_H

#include "walkthrough/walkthrough.h"

typedef struct WalkthroughBox {
    int node, level;
    bool leaf, entered; /* entered: by one of the rays at least */
    Vec3 corners[8]; /* as in the scene file; corner k is on the high side in x, y, z where bit 0, 1, 2 of k is set */
} WalkthroughBox;

/* With corners alone. */
WalkthroughBox walkthrough_box(const Scene *scene, const Box *box);

enum { BOX_EDGES = 12 };
extern const int walkthrough_box_edges[BOX_EDGES][2]; /* the two corners of each */

/* Calls `draw` once for every node that a ray of the told sample met. False for want of memory. */
bool walkthrough_boxes(const Walkthrough *walk, void (*draw)(void *user, const WalkthroughBox *box), void *user,
                       Error *error);

#endif
