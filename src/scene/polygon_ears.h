/* Ear clipping (Meisters, "Polygons have ears", 1975): a triangle between three vertices in a row that nothing of the
 * boundary enters is cut off, until none is left. Of all ears the one with the shortest new edge is taken, which avoids
 * thin triangles, and two triangles become a quad where they can. */
#ifndef RECTRAY_POLYGON_EARS_H
#define RECTRAY_POLYGON_EARS_H

#include "scene/polygon_ring.h"

/* Cuts the whole ring into its pieces. False where something is left that has no ear: the boundary crosses itself. */
bool polygon_ears_cut(PolygonRing *ring);

#endif
