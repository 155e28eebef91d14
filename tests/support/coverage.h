/* The exact box-filtered picture of faces that nothing shades: how much of a pixel each face is seen in, by rational
 * arithmetic without any rounding (GMP). It shares nothing with the tracers but the scene and its view.
 *
 * From one eye, everything is affine in the place (x, y) on the screen, for the ray's direction R is. A ray passes edge
 * v -> w of a face on the inner side where the sign of ((v - eye) x (w - eye)).R says so, and 1/t = N.R / N.(v - eye):
 * a face covers a convex polygon, and of two faces the one is nearer on one side of a line. So what hides a face from
 * the eye is an intersection of half planes, and what is left of it in the pixel is a set of convex polygons. */
#ifndef RECTRAY_TESTS_COVERAGE_H
#define RECTRAY_TESTS_COVERAGE_H

#include "scene/scene.h"

enum { COVERAGE_FACES = 64 };

typedef struct Coverage {
    double face[COVERAGE_FACES]; /* the share of the pixel's area in which the face is nearest, rounded once */
    double background;
    int lines; /* lines across the pixel at which the colour may change: edges of faces, and where two faces cross */
} Coverage;

/* The scene must have at most COVERAGE_FACES faces. */
Coverage coverage_of_pixel(const Scene *scene, int column, int row);

/* No grid of n x n rays is farther from the exact value of a pixel than this share of its contrast, the difference of
 * its largest and its smallest colour. A line meets at most 2n - 1 of the n x n cells, and in each the centre stands
 * for the larger part: of a cell's area no more than half is on the other side. */
double coverage_grid_bound(int lines, int n);

#endif
