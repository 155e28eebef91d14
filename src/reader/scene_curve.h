/* Curves through keys: what share each key has in a value at a frame between them. A share does not depend on the
 * values, so that numbers, points and angles all move by the same few lines. */
#ifndef RECTRAY_SCENE_CURVE_H
#define RECTRAY_SCENE_CURVE_H

#include <stdbool.h>

/* When a key is reached, and how the way from it to the next one goes. */
typedef struct CurveKey {
    double frame; /* larger than that of the key before */
    bool smooth;  /* else along a straight line, at an even pace */
} CurveKey;

/* The value at a frame is the sum of share[i] times the value of key first + i. The shares' sum is 1. */
typedef struct CurveShares {
    int first, count;
    double share[4];
} CurveShares;

/* The shares of `count` keys, at least 1, at a frame. Before the first key and after the last one the value rests. At
 * a key the value is exactly the key's.
 * Smooth is the curve of Catmull and Rom ("A class of local interpolating splines", in Computer Aided Geometric
 * Design, 1974), for keys at any distances: between keys 1 and 2 it goes over from the parabola through keys 0, 1, 2 to
 * the parabola through keys 1, 2, 3 (Barry and Goldman, "A recursive evaluation algorithm for a class of Catmull-Rom
 * splines", 1988). On the first and the last stretch there is one parabola. */
CurveShares scene_curve_shares(const CurveKey *keys, int count, double frame);

#endif
