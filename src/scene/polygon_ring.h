/* The boundary of a polygon while it is cut: a ring of vertices that loses them one by one. */
#ifndef RECTRAY_POLYGON_RING_H
#define RECTRAY_POLYGON_RING_H

#include "base/vec3.h"

#include <stdbool.h>

/* A triangle or a convex quad, by numbers of the polygon's vertices, in their order. */
typedef struct PolygonPiece {
    int corners[4];
    int count; /* 3 or 4 */
} PolygonPiece;

/* One vertex. Where it stands in the plane serves to skip what is far away, and to compare lengths: it is rounded. */
typedef struct PolygonVertex {
    Vec3 at;
    double u, v;        /* in the plane, but for rounding */
    int next, previous; /* in the ring */
    int beyond;         /* the piece on the other side of the edge to `next`; -1: the edge is the polygon's own */
    double diagonal;    /* from `previous` to `next`, squared; HUGE_VAL where that triangle may not be cut off */
} PolygonVertex;

typedef struct PolygonRing {
    Vec3 normal;   /* of any length; what "inside" and "left" mean is seen along it */
    double margin; /* more than the rounding of u and v */
    int count;     /* vertices of the polygon */
    int left;      /* of them still in the ring */
    bool touches;  /* the boundary meets itself at `touch`, two edges */
    int touch[2];  /* by their first vertices */
    bool relaxed;  /* see polygon_ears_cut */
    int fold;      /* a vertex at which the boundary turns back along itself, -1: none. No piece has that vertex */
    PolygonVertex *vertices;
    PolygonPiece *pieces; /* what was cut off */
    int piece_count;
} PolygonRing;

/* +1 where a, b, c turn to the left, -1 to the right, 0 on a line: exact. */
int polygon_ring_turn(const PolygonRing *ring, int a, int b, int c);

/* Does the boundary turn back along itself at vertex b? */
bool polygon_ring_folds(const PolygonRing *ring, int a, int b, int c);

/* Looks at each pair of edges. Returns whether two cross in a point inside both, and then which, by their first
 * vertices; else fills ring->touches. */
bool polygon_ring_crosses(PolygonRing *ring, int *first, int *second);

/* Whether two pieces have more in common than edges. */
bool polygon_ring_pieces_overlap(const PolygonRing *ring);

/* Whether four vertices are a convex quad that may be traced whole. */
bool polygon_ring_is_quad(const PolygonRing *ring, const int *corners);

#endif
