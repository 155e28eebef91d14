/* The input of a traversal of a tree along a ray, and its callbacks. Both trees are traversed this way, the nearest box
 * first, for the nearest face and for any face alike. */
#ifndef RECTRAY_TRAVERSAL_H
#define RECTRAY_TRAVERSAL_H

#include "scene/box.h"

#include <stdbool.h>
#include <stdint.h>

typedef struct Traversal Traversal;

/* A node that the traversal came to: entered, or left aside
 * because the ray misses it or reaches it beyond the limit. */
typedef struct TraversalNode {
    int node, level; /* the root's level is 0 */
    int faces;       /* in a leaf; 0 in an inner node */
    bool entered;
} TraversalNode;

struct Traversal {
    Vec3 origin, direction;
    double limit;                                  /* boxes that the ray enters beyond this t are left out */
    bool (*visit)(Traversal *traversal, int face); /* may lower the limit; returns false to end the traversal */
    void (*node)(const Traversal *traversal, TraversalNode visit); /* NULL: nobody listens */
    void *user;
    uint64_t box_tests; /* counted by the traversal */
};

#endif
