/* Exercise 3: is a point of the plane inside the face? The README beside this file tells the task.
 *
 * What you may use, all of it short, in src/trace/textbook_real.h:
 *     Real                                     a number, a double here
 *     Real3                                    a point or a vector, with .x, .y and .z
 *     add(a, b), subtract(a, b), scale(s, a)   a + b, a - b, s a
 *     dot(a, b), cross(a, b)                   a.b, a x b
 *     vertex(face, k)                          v[k] of the face; after the last vertex comes v[0] again
 *     face->vertex_count                       3 or 4
 */
#include "trace/textbook_real.h"

/* Is the point hit->p, which lies in the plane of the face, inside it?
 *
 * n is the face's unit normal N. Edge k goes from v[k] to v[k+1]; the last one goes back to v[0].
 * For each edge, in order from k = 0, fill
 *     hit->edge[k]   N.(e x c), where e = v[k+1] - v[k] and c = hit->p - v[k]
 *     hit->edges     how many edges you have looked at so far, with this one
 * The first edge with a number less than 0 decides: give back false, and look at no other.
 * Give back true if there is none. A point on an edge is inside. */
static bool inside_edges(const Face *face, Real3 n, Hit *hit)
{
    /* Your lines. */
    return false;
}
