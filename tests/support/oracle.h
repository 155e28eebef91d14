/* The exact oracle: what a ray meets, by integer arithmetic without any rounding (GMP).
 * It shares nothing with the tracers but what a face is: four float32 vertices, a triangle repeating its first. A ray
 * is six doubles, origin and direction. A finite double is an integer times a power of two, so that every determinant
 * below is an integer, every comparison of two t a cross-multiplication.
 * A quad whose rounded vertices lie a little off one plane: inside are the rays that pass all four edges on one side
 * (signs of four volumes, 0 allowed, not all 0), its plane goes through vertex 0, normal to (v2 - v0) x (v3 - v1). */
#ifndef RECTRAY_TESTS_ORACLE_H
#define RECTRAY_TESTS_ORACLE_H

#include <stdbool.h>

/* Does the ray hit the face, edges included, at a t > 0? */
bool oracle_hits(const float face[4][3], const double ray[6]);

/* The sign of t(a) - t(b); the ray must not be parallel to either plane. */
int oracle_order(const float a[4][3], const float b[4][3], const double ray[6]);

/* The side of the face's plane that the point is on: +1 where the normal points, 0 in it, -1 behind. */
int oracle_side(const float face[4][3], const double point[3]);

/* The side that the direction of the ray points to: the sign of N.R. */
int oracle_heading(const float face[4][3], const double ray[6]);

/* Is the face hit strictly between the two points (edges included, the ends not)? */
bool oracle_blocks(const float face[4][3], const double from[3], const double to[3]);

/* t of the plane hit, rounded to a double, and `t` minus the exact value; the ray must not be parallel to the plane. */
double oracle_t(const float face[4][3], const double ray[6]);
double oracle_t_error(const float face[4][3], const double ray[6], double t);

/* Most signs are plain from a long double and its error bound. This turns that short cut off, to check it. */
extern bool oracle_integers_only;

void oracle_free(void);

#endif
