/* Ear clipping, and the joining of triangles to quads. */
#include "scene/polygon_ears.h"

#include <math.h>

/* Does the boundary at vertex w, which is in the triangle or on its edges, enter the inside of the triangle? `turns`
 * says on which side of each edge it is. */
static bool enters(const PolygonRing *ring, const int *triangle, const int *turns, int w)
{
    const int ends[2] = {ring->vertices[w].next, ring->vertices[w].previous};
    for (int end = 0; end < 2; end++) {
        bool inward = true;
        for (int i = 0; i < 3 && inward; i++)
            inward = turns[i] > 0 || polygon_ring_turn(ring, triangle[i], triangle[(i + 1) % 3], ends[end]) > 0;
        if (inward)
            return true;
    }
    return false;
}

/* Does vertex w keep the triangle from being an ear? Its edge 2 -> 0 is the new one. */
static bool blocks(const PolygonRing *ring, const int *triangle, int w)
{
    int turns[3], inside = 0;
    for (int i = 0; i < 3; i++) {
        turns[i] = polygon_ring_turn(ring, triangle[i], triangle[(i + 1) % 3], w);
        if (turns[i] < 0)
            return false;
        inside += turns[i] > 0;
    }
    if (inside == 3)
        return true;
    bool on_new_edge = turns[2] == 0 && inside == 2;
    return !ring->relaxed && (on_new_edge || enters(ring, triangle, turns, w));
}

static double smallest(double a, double b, double c)
{
    return fmin(a, fmin(b, c));
}

static double largest(double a, double b, double c)
{
    return fmax(a, fmax(b, c));
}

static bool is_ear(const PolygonRing *ring, int vertex)
{
    const PolygonVertex *v = &ring->vertices[vertex];
    const int triangle[3] = {v->previous, vertex, v->next};
    const PolygonVertex *p = &ring->vertices[v->previous], *n = &ring->vertices[v->next];
    if (polygon_ring_turn(ring, triangle[0], triangle[1], triangle[2]) <= 0)
        return false;
    double left = smallest(p->u, v->u, n->u) - ring->margin, right = largest(p->u, v->u, n->u) + ring->margin;
    double low = smallest(p->v, v->v, n->v) - ring->margin, high = largest(p->v, v->v, n->v) + ring->margin;
    for (int w = n->next; w != v->previous; w = ring->vertices[w].next) {
        const PolygonVertex *other = &ring->vertices[w];
        bool far = other->u < left || other->u > right || other->v < low || other->v > high;
        if (!far && blocks(ring, triangle, w))
            return false;
    }
    return true;
}

static void measure(PolygonRing *ring, int vertex)
{
    PolygonVertex *v = &ring->vertices[vertex];
    const PolygonVertex *p = &ring->vertices[v->previous], *n = &ring->vertices[v->next];
    double u = n->u - p->u, w = n->v - p->v;
    v->diagonal = HUGE_VAL;
    if (is_ear(ring, vertex)) /* a quad is cut from vertex 0 to 2 if it can be */
        v->diagonal = ring->count == 4 ? vertex != 1 : u * u + w * w;
}

static void measure_all(PolygonRing *ring, int start)
{
    int vertex = start;
    do {
        measure(ring, vertex);
        vertex = ring->vertices[vertex].next;
    } while (vertex != start);
}

/* The ear with the shortest new edge; -1: there is none. */
static int find_ear(const PolygonRing *ring, int start)
{
    int best = -1, vertex = start;
    double shortest = HUGE_VAL;
    do {
        if (ring->vertices[vertex].diagonal < shortest) {
            best = vertex;
            shortest = ring->vertices[vertex].diagonal;
        }
        vertex = ring->vertices[vertex].next;
    } while (vertex != start);
    return best;
}

static int take_out(PolygonRing *ring, int vertex, int beyond)
{
    PolygonVertex *v = &ring->vertices[vertex];
    ring->vertices[v->next].previous = v->previous;
    ring->vertices[v->previous].next = v->next;
    ring->vertices[v->previous].beyond = beyond;
    ring->left--;
    return v->previous;
}

/* Takes out the vertices at which the boundary turns back along itself, at `start`, at the vertex after it and, once
 * one is out, beside it: no area is lost. Returns a vertex that is left, the one before the last that was taken out. */
static int unfold(PolygonRing *ring, int start)
{
    for (int seen = 0, vertex = start; ring->left > 2 && seen < 2;) {
        const PolygonVertex *v = &ring->vertices[vertex];
        if (polygon_ring_folds(ring, v->previous, vertex, v->next)) {
            if (ring->piece_count == 0 && ring->fold < 0)
                ring->fold = vertex;
            start = vertex = take_out(ring, vertex, -1);
            seen = 0;
        } else {
            vertex = v->next;
            seen++;
        }
    }
    return start;
}

/* Joins the triangle to the one beyond its edge `edge`, if the two are a convex quad. Every triangle is offered only to
 * the later one beside it, and the triangles of a polygon are a tree: so no other choice makes fewer pieces of them. */
static bool join(PolygonRing *ring, const int *triangle, int edge)
{
    int beyond = ring->vertices[triangle[edge]].beyond;
    if (beyond < 0 || ring->pieces[beyond].count != 3)
        return false;
    PolygonPiece *piece = &ring->pieces[beyond];
    const int quad[4] = {triangle[edge], piece->corners[1], triangle[(edge + 1) % 3], triangle[(edge + 2) % 3]};
    if (!polygon_ring_is_quad(ring, quad))
        return false;
    *piece = (PolygonPiece){.corners = {quad[0], quad[1], quad[2], quad[3]}, .count = 4};
    return true;
}

/* Adds the triangle at an ear. Returns its piece, as what lies beyond the new edge; that may be a quad now. */
static int add_triangle(PolygonRing *ring, int ear)
{
    const PolygonVertex *v = &ring->vertices[ear];
    const int triangle[3] = {v->previous, ear, v->next};
    int edges = ring->left == 3 ? 3 : 2; /* of the last triangle all edges are old ones */
    for (int edge = 0; edge < edges; edge++)
        if (join(ring, triangle, edge))
            return ring->vertices[triangle[edge]].beyond;
    ring->pieces[ring->piece_count] = (PolygonPiece){.corners = {triangle[0], ear, triangle[2]}, .count = 3};
    return ring->piece_count++;
}

/* Is what is left without any area? */
static bool is_flat(const PolygonRing *ring, int start)
{
    int vertex = start;
    do {
        const PolygonVertex *v = &ring->vertices[vertex];
        if (polygon_ring_turn(ring, v->previous, vertex, v->next) != 0)
            return false;
        vertex = v->next;
    } while (vertex != start);
    return true;
}

/* Where the boundary touches itself, a vertex may lie on an edge and be in no one's way. So when no ear is left, only
 * vertices inside a triangle count ("relaxed"): a wrong choice can not give wrong pieces, it only ends in an error. */
bool polygon_ears_cut(PolygonRing *ring)
{
    int start = 0;
    for (int i = 0; i < ring->count && ring->left > 2; i++) /* each vertex may turn back */
        start = unfold(ring, ring->vertices[start].next);
    measure_all(ring, start);
    while (ring->left > 2) {
        int ear = find_ear(ring, start);
        if (ear < 0 && !ring->relaxed) {
            ring->relaxed = true;
            measure_all(ring, start);
            ear = find_ear(ring, start);
        }
        if (ear < 0)
            return is_flat(ring, start);
        start = take_out(ring, ear, add_triangle(ring, ear));
        start = unfold(ring, start);
        measure(ring, start);
        measure(ring, ring->vertices[start].next);
    }
    return true;
}
