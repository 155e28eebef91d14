/* The input of a traversal of a tree along a ray, and its callbacks. Both trees are traversed this way, the nearest box
 * first, for the nearest face and for any face alike. */
#ifndef RECTRAY_TRAVERSAL_H
#define RECTRAY_TRAVERSAL_H

#include "scene/box.h"

#include <stdbool.h>
#include <stdint.h>

typedef struct Traversal Traversal;

/* What becomes of a node whose box was tested. */
typedef enum NodeVerdict {
    NODE_ENTERED,
    NODE_MISSED,   /* the ray is never in its box */
    NODE_BEYOND,   /* the ray reaches it beyond the limit */
    NODE_UNNEEDED, /* the traversal ended before */
    NODE_VERDICT_COUNT
} NodeVerdict;

typedef struct TraversalNode {
    int node, level; /* the root's level is 0 */
    NodeVerdict verdict;
    Interval inside; /* when the ray is in its box */
    double limit;    /* at that time */
} TraversalNode;

struct Traversal {
    Vec3 origin, direction;
    double limit;                                  /* boxes that the ray enters beyond this t are left out */
    bool (*visit)(Traversal *traversal, int face); /* may lower the limit; returns false to end the traversal */
    void (*node)(const Traversal *traversal, TraversalNode visit); /* NULL: nobody listens */
    void *user;
    uint64_t box_tests; /* counted by the traversal */
};

/* Whether a node is entered whose box the ray is in during `inside`. */
static inline NodeVerdict traversal_verdict(const Traversal *traversal, Interval inside)
{
    if (!(inside.enter <= inside.leave))
        return NODE_MISSED;
    return inside.enter <= traversal->limit ? NODE_ENTERED : NODE_BEYOND;
}

#endif
