/* Fails at middle_of_a_square: k + 1: it counts. */
#include "trace/textbook_real.h"

static bool inside_edges(const Face *face, Real3 n, Hit *hit)
{
    for (int k = 0; k < face->vertex_count; k++) {
        Real3 e = subtract(vertex(face, k + 1), vertex(face, k)), c = subtract(hit->p, vertex(face, k));
        hit->edge[k] = dot(n, cross(e, c));
        hit->edges = k;
        if (hit->edge[k] < 0)
            return false;
    }
    return true;
}
