/* Faces that are no good quads or triangles as they are: what is left of them, in pieces, or why there is nothing. */
#ifndef RECTRAY_SCENE_POLYGON_H
#define RECTRAY_SCENE_POLYGON_H

#include "reader/scene_build.h"

/* Cuts a face of the object into build->cut.ring.pieces, whose corners are indices into build->corners. Where the
 * object says so ("degenerate": "skip"), points that repeat the one before and boundaries that turn back along
 * themselves are left out with a note, and a face without area has no pieces. Fails with a reason. */
bool scene_polygon_cut(SceneBuild *build, const int *vertices, int count, int place);

#endif
