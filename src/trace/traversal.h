/* A walk through a tree along a ray: what the walker is told, and whom it tells. Both trees are walked this way, nearest
 * box first, for the nearest face and for any face alike. */
#ifndef RECTRAY_WALK_H
#define RECTRAY_WALK_H

#include "scene/box.h"

#include <stdbool.h>
#include <stdint.h>

typedef struct Walk Walk;

/* A node that the walker came to: entered, or left aside because the ray misses it or reaches it beyond the limit. */
typedef struct WalkNode {
    int node, level; /* the root's level is 0 */
    int faces;       /* in a leaf; 0 in an inner node */
    bool entered;
} WalkNode;

struct Walk {
    Vec3 origin, direction;
    double limit;                                   /* boxes that the ray enters beyond this t are left out */
    bool (*visit)(Walk *walk, int face);            /* may lower the limit; returns false to end the walk */
    void (*node)(const Walk *walk, WalkNode visit); /* NULL: nobody listens */
    void *user;
    uint64_t box_tests; /* counted by the walk */
};

#endif
