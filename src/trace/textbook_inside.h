/* Step 4 of the textbook tracer: is a point of the plane inside the face? */
#ifndef RECTRAY_TEXTBOOK_INSIDE_H
#define RECTRAY_TEXTBOOK_INSIDE_H

#include "trace/textbook_real.h"

/* Is the point hit->p on no edge's outer side? Fills hit->edge[k] = N.(e x c) for each edge k that it looks at, and
 * hit->edges, their number. The first edge that P is outside of is the last one. */
static bool inside_edges(const Face *face, Real3 n, Hit *hit)
{
    for (int k = 0; k < face->vertex_count; k++) {
        Real3 e = subtract(vertex(face, k + 1), vertex(face, k)), c = subtract(hit->p, vertex(face, k));
        hit->edge[k] = dot(n, cross(e, c));
        hit->edges = k + 1;
        if (hit->edge[k] < 0)
            return false; /* outside edge k */
    }
    return true;
}

#endif
