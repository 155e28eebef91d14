/* How a tree is built, step by step: each node with the planes that were tried and what each would cost. The tree is
 * there already; what its builder saw is made again for the nodes that are looked at. */
#ifndef RECTRAY_TREE_STEP_H
#define RECTRAY_TREE_STEP_H

#include "trace/accel.h"

/* A plane that was tried. */
typedef struct TreeCandidate {
    int axis;
    double plane;
    int low, high; /* faces on each side; in a k-d tree some are on both */
    double cost;   /* in face tests */
} TreeCandidate;

typedef struct TreeStep {
    int number, node, level; /* number: from 1 */
    AccelNode shape;
    int faces;
    const TreeCandidate *candidates;
    int candidate_count;
    int chosen;    /* the cheapest candidate; -1: none was tried */
    int set_apart; /* faces of a BVH that are set apart since they are large, whatever the candidates cost; else 0 */
    int low, high; /* faces of the children that it has got */
} TreeStep;

/* Shows the first `count` nodes, level by level. False for want of memory. */
bool tree_steps(const Scene *scene, const Accel *accel, int count, void (*show)(void *user, const TreeStep *step),
                void *user, Error *error);

#endif
