/* The faces' part of finishing a scene: shapes, box, rounding, planes; eight faces at a time, on all processors. */
#ifndef RECTRAY_FINISH_FACES_H
#define RECTRAY_FINISH_FACES_H

#include "reader/scene_build.h"

/* Looks at the shapes that nobody has checked yet, and sets the corners of the box around the vertices of all faces;
 * without a face they stay. On failure the build has the first face that is not valid. */
bool finish_faces_check(SceneBuild *build, Vec3 *low, Vec3 *high);

/* Fills the scene's faces and planes: vertices relative to its centre, rounded to float32. Faces that lose their area
 * are left out where they may be. On failure the build has the first face that cannot be, and the reason. */
bool finish_faces_round(SceneBuild *build);

#endif
