/* The verdict on a face's shape, before it is traced: vertices apart, area, planar, convex. docs/scene-format.md lists
 * the verdicts and their bounds for the users; this is where they are decided. */
#ifndef RECTRAY_SHAPE_H
#define RECTRAY_SHAPE_H

#include "base/vec3.h"

/* How far a vertex may be from the plane, in longer diagonals; how far a corner may turn the other way, in areas. */
#define SHAPE_PLANARITY 1e-5
#define SHAPE_STRAIGHTNESS 1e-5
#define SHAPE_ROUNDED_STRAIGHTNESS 1e-2

typedef enum ShapeVerdict {
    SHAPE_GOOD,
    SHAPE_NOT_FINITE,
    SHAPE_REPEATED,   /* vertices `first` and `second` are the same point */
    SHAPE_NO_AREA,    /* its vertices lie on one line */
    SHAPE_NOT_PLANAR, /* vertex `first` is `distance` from the plane */
    SHAPE_CONCAVE,    /* it turns the other way at vertex `first` */
    SHAPE_CROSSED,    /* two of its sides cross: the bow-tie */
} ShapeVerdict;

typedef struct Shape {
    ShapeVerdict verdict; /* the first that applies, in the order of docs/scene-format.md */
    int first, second;
    double distance; /* from the plane through vertex 0 with the normal of the diagonals */
    double diagonal; /* the longer diagonal; of a triangle the longest side */
} Shape;

/* vertices: 3 or 4 points, in double, as the scene gives them after its transforms. A quad is planar when no vertex is
 * farther from the plane than 1e-5 of the longer diagonal. A corner may be straight: it counts as turning the other way
 * when its triangle is more than 1e-5 of the face's area on the wrong side. An area is zero when it is
 * below what rounding the coordinates can make of zero. */
Shape shape_of(const Vec3 *vertices, int count);

/* The same for vertices that were rounded to float32: planar or not does not matter, an area counts when it is not
 * zero, and a corner may bend inwards by 1/100 of the face's area. */
Shape shape_of_rounded(const Vec3 *vertices, int count);

#endif
