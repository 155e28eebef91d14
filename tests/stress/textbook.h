/* The baseline: the formulas that the project teaches, taken literally in float32, as a first program would have them.
 * The plane's D, the hit point, the sign of dot(N, cross(e, c)) at each edge, the point shifted by a fixed 1e-5. The
 * table of docs/stability.md shows beside it what the cures buy. */
#ifndef RECTRAY_STRESS_TEXTBOOK_H
#define RECTRAY_STRESS_TEXTBOOK_H

#include "scene/scene.h"
#include "trace/render.h"

#include <stdbool.h>

/* Rays are six doubles that hold floats. Returns whether the face is hit; *t is then the ray's parameter. */
bool textbook_hits(const Face *face, const double ray[6], double *t);

CastHit textbook_nearest(const Scene *scene, const double ray[6]);

/* Is any face but `left` hit between the two points? */
bool textbook_blocked(const Scene *scene, const double segment[6], int left);

/* The hit point, and the point 1e-5 off the face on the side that the ray came from. */
void textbook_points(const Scene *scene, const double ray[6], CastHit hit, double point[3], double shifted[3]);

#endif
