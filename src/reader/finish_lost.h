/* Faces that lose their area when they are rounded to float32. They would cover nothing, so they may be left out: with
 * a note where the object skips what has no area, silently where other pieces of the same face stay. */
#ifndef RECTRAY_FINISH_LOST_H
#define RECTRAY_FINISH_LOST_H

#include "reader/scene_build.h"

extern const char finish_lost_reason[];

/* May the face be left out, as far as one can tell without its other pieces? */
bool finish_lost_may_be(const SceneBuild *build, int index);

/* Makes the triangle that is left of a quad without a vertex: one that became the same point as another, or that bends
 * inwards. The quad was convex before it was rounded, so the triangle is no farther from it than rounding takes it. */
void finish_lost_point(Face *face, int vertex);

/* Leaves out the scene's faces that have no vertices. On failure the build has the face that may not be left out. */
bool finish_lost_drop(SceneBuild *build);

#endif
