/* Random polygons on a grid of whole numbers, so that what crosses or touches what can be told in 64 bits. */
#ifndef RECTRAY_TESTS_RANDOM_POLYGON_H
#define RECTRAY_TESTS_RANDOM_POLYGON_H

#include <stdbool.h>
#include <stdint.h>

enum { GRID_POLYGON_MAX = 64, GRID_POLYGON_SIZE = 1 << 20 };

typedef struct GridPolygon {
    int count;
    int64_t x[GRID_POLYGON_MAX], y[GRID_POLYGON_MAX]; /* 0 to GRID_POLYGON_SIZE */
} GridPolygon;

typedef enum GridPolygonKind {
    GRID_CONVEX,
    GRID_STAR,   /* any distance in any direction from a centre */
    GRID_KNOT,   /* random points in an order without crossings: as concave as it gets */
    GRID_COARSE, /* the same on a grid of few points: vertices in line, at one point, on edges */
    GRID_THIN,   /* the same squeezed to a few units across a slanted line */
    GRID_WILD,   /* random points in random order */
    GRID_POLYGON_KINDS
} GridPolygonKind;

GridPolygon grid_polygon(GridPolygonKind kind, uint64_t *random);

/* Twice the area, counted with the sense of rotation. */
int64_t grid_polygon_area2(const GridPolygon *polygon);

/* Do the edges that begin at vertices i and k cross in a point inside both? */
bool grid_edges_cross(const GridPolygon *polygon, int i, int k);

/* Some two edges, for the whole polygon. */
bool grid_polygon_crosses(const GridPolygon *polygon);

/* Do some two edges that are no neighbours have a point in common, or neighbours more than their vertex? */
bool grid_polygon_touches(const GridPolygon *polygon);

#endif
