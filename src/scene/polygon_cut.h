/* A face of any number of vertices, as convex quads and triangles that cover the same points and no others. Every
 * yes-or-no (which way a corner turns, what crosses what, which vertex is inside a triangle) is an exact sign for the
 * vertices that it is given, seen along the polygon's normal: so the pieces are right however thin the polygon is.
 *
 * Why the pieces are right: whatever vertex is cut off first, the triangles add up to the polygon, each counted
 * with the sense in which it turns (the edges between them cancel). Where all of them turn as the polygon does, each
 * point is in as many triangles as the boundary goes round it: once, when the boundary does not cross itself. */
#ifndef RECTRAY_POLYGON_CUT_H
#define RECTRAY_POLYGON_CUT_H

#include "base/error.h"
#include "scene/polygon_ring.h"

typedef enum PolygonVerdict {
    POLYGON_GOOD,
    POLYGON_NO_AREA,    /* its vertices lie on one line, or its boundary only runs to and fro */
    POLYGON_NOT_PLANAR, /* vertex `first` is `distance` from the plane, and 1e-5 of `size` is allowed */
    POLYGON_CROSSED,    /* the edges that begin at vertices `first` and `second` cross */
} PolygonVerdict;

/* Keeps its memory from one polygon to the next; begins zeroed. */
typedef struct PolygonCut {
    PolygonVerdict verdict;
    bool is_bent; /* it was not planar */
    int first, second;
    double distance, size;
    PolygonRing ring; /* its pieces are the answer; none unless the verdict is good */
    int capacity;     /* vertices for which there is memory */
} PolygonCut;

/* Cuts a polygon of at least 3 vertices, all finite. A face of 3 or 4 that shape.h calls good is one piece. A quad is
 * cut from vertex 0 to 2 where that stays inside. A `bent` polygon need not be planar. False without memory.
 *
 * Planar means: no vertex is farther than 1e-5 of the polygon's size from the plane through the middle of its vertices
 * whose normal is the sum of the cross products around it (Newell's). The size is the diagonal of the box around the
 * vertices. Of a quad it is the longer diagonal, and the plane goes through vertex 0. */
bool polygon_cut(PolygonCut *cut, const Vec3 *vertices, int count, bool bent, Error *error);

void polygon_cut_free(PolygonCut *cut);

/* Leaves out each number whose vertex is at the same point as the one before it, around the polygon, and returns how
 * many numbers are left. Where all are one point, one is left. */
int polygon_drop_repeats(const Vec3 *vertices, int *numbers, int count);

#endif
