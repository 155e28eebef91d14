/* What the formulas of tracing say: screen mapping, planes, the plane hit, the inside test, the shifted point.
 * Pure functions of their arguments, in double. Every yes-or-no they give (parallel, behind, which side of an
 * edge) is exact for the numbers they are given: see exact.h and docs/bounds.md. */
#ifndef RECTRAY_GEOMETRY_H
#define RECTRAY_GEOMETRY_H

#include "scene/box.h"
#include "scene/scene.h"

/* P(t) = origin + t direction; the direction need not be a unit vector, t is measured in its length. */
typedef struct Ray {
    Vec3 origin, direction;
} Ray;

/* The camera's frame: a primary ray is P(t) = eye + t (forward + x right + y up), t = 1 on the screen. */
typedef struct View {
    Vec3 eye;
    Vec3 forward;   /* distance * unit(look_at - position) */
    Vec3 right, up; /* unit vectors along a row and up a column */
    double width, height;
    int columns, rows, grid;
} View;

/* The scene's view. The camera must have passed the reader's
 * checks: look_at != position, up not parallel to the view. */
View view_of(const Scene *scene);

/* A point of the screen, from its centre: x along right, y along up. */
typedef struct ScreenPoint {
    double x, y;
} ScreenPoint;

/* The centre of sub-pixel (i, j) of pixel (column, row), row 0 at the top. */
ScreenPoint view_screen_point(const View *view, int column, int row, int i, int j);

/* The direction R = Q - C to that point. */
Vec3 view_direction(const View *view, int column, int row, int i, int j);

/* The plane through vertex 0 with the unit normal of the diagonals, N = unit((v2 -
 * v0) x (v3 - v1)): for a triangle, whose v3 is v0, the normal of two sides.
 * Right-hand rule over the vertex order. A face without area gives a zero normal. */
Plane face_plane(const Face *face);

Vec3 face_vertex(const Face *face, int index);

/* A box around the vertices, and around the points where a ray hits the plane inside the
 * edges: rounding and, for a quad that rounding left a little warped, the distance of its
 * vertices from the plane part the two. The margin covers rays at 1/256 or more to the plane;
 * FaceTest.t_in_box takes care of those that graze it. None for a face across an axis. */
Box face_box(const Face *face, const Plane *plane);

typedef enum FaceVerdict {
    FACE_PARALLEL, /* N.R = 0 */
    FACE_BEHIND,   /* t <= 0 */
    FACE_BACK,     /* reached from behind its normal, and it is one-sided */
    FACE_FARTHER,  /* t is larger than the limit, or beyond the light */
    FACE_OUTSIDE,  /* the plane is hit outside edge `outside_edge` */
    FACE_INSIDE,   /* hit */
    FACE_LEFT,     /* the face that the ray leaves: not tested */
    FACE_VERDICT_COUNT
} FaceVerdict;

/* One face against one ray, with every number of the walkthrough. Values that were not needed stay 0. */
typedef struct FaceTest {
    FaceVerdict verdict;
    double n_dot_r;        /* N.R, its sign exact */
    double n_dot_o_plus_d; /* N.O + D, as N.(O - v0), its sign exact */
    double t;
    double t_in_box; /* of a hit: t, or the nearest t at which the ray is in face_box; it decides what is nearest */
    int edges;       /* edges evaluated: 0, 3 or 4 */
    double edge_value[4]; /* dot(N, cross(e, c)) of edge k = v[k] -> v[k+1] */
    int edge_sign[4];     /* its exact sign: -1, 0, +1; 0 is on the edge's line */
    int outside_edge;     /* the first edge whose sign is -1; -1 where none is */
} FaceTest;

/* Tests a ray: a hit has t > 0 and t_in_box <= limit (HUGE_VAL: no limit). With `complete` the edges are evaluated for
 * every face whose plane is hit, else only where the verdict needs them.
 * The edge signs are those of det(R, v[k] - O, v[k+1] - O) = (N.R) dot(N, cross(e, c)) for P = O + t R in the plane,
 * the signed volume of Moeller and Trumbore 1997 section 2.2 / Shewchuk 1997, which needs no hit point. */
FaceTest face_test(const Face *face, const Plane *plane, Ray ray, double limit, bool complete);

/* along . ((to - from) x (point - from)), its sign exact: > 0 where `point` is on the left of the line from `from` to
 * `to` for one at whom `along` points. */
double point_left_of(Vec3 along, Vec3 from, Vec3 to, Vec3 point);

/* Tests the segment from `from` to `to`: inside means that the face is strictly between them. t runs from 0 to 1. */
FaceTest face_test_segment(const Face *face, const Plane *plane, Vec3 from, Vec3 to, bool complete);

/* The side of the face's plane that the point lies on, exact: +1 where N points, 0 in the plane, -1 behind. */
int plane_side(const Face *face, const Plane *plane, Vec3 point);

/* The point P (on the face but for rounding) moved along the unit vector n = +N or -N so that it lies on n's side of
 * the plane, about 8 ulp of the coordinates away. The bound is proved in docs/bounds.md. */
Vec3 point_shifted(const Face *face, const Plane *plane, Vec3 n, Vec3 point);

#endif
