/* What the vertices of a polygon say about one another, decided exactly. */
#include "scene/polygon_ring.h"

#include "scene/geometry.h"
#include "scene/shape.h"

int polygon_ring_turn(const PolygonRing *ring, int a, int b, int c)
{
    const PolygonVertex *v = ring->vertices;
    double volume = point_left_of(ring->normal, v[a].at, v[b].at, v[c].at);
    return (volume > 0) - (volume < 0);
}

bool polygon_ring_folds(const PolygonRing *ring, int a, int b, int c)
{
    const PolygonVertex *v = ring->vertices;
    if (polygon_ring_turn(ring, a, b, c) != 0)
        return false;
    double u = (v[b].u - v[a].u) * (v[c].u - v[b].u), w = (v[b].v - v[a].v) * (v[c].v - v[b].v);
    return !(u + w > 0);
}

typedef struct Span {
    double low, high;
} Span;

static Span span_of(double a, double b)
{
    return a < b ? (Span){a, b} : (Span){b, a};
}

static bool spans_are_apart(Span a, Span b, double margin)
{
    return a.low > b.high + margin || b.low > a.high + margin;
}

/* Edges a -> next and c -> next. */
static bool edges_are_apart(const PolygonRing *ring, const PolygonVertex *a, const PolygonVertex *c)
{
    const PolygonVertex *b = &ring->vertices[a->next], *d = &ring->vertices[c->next];
    return spans_are_apart(span_of(a->u, b->u), span_of(c->u, d->u), ring->margin) ||
           spans_are_apart(span_of(a->v, b->v), span_of(c->v, d->v), ring->margin);
}

bool polygon_ring_crosses(PolygonRing *ring, int *first, int *second)
{
    for (int a = 0; a < ring->count; a++)
        for (int c = a + 2; c < ring->count; c++) {
            int b = ring->vertices[a].next, d = ring->vertices[c].next;
            if (d == a || edges_are_apart(ring, &ring->vertices[a], &ring->vertices[c]))
                continue;
            int sides = polygon_ring_turn(ring, a, b, c) * polygon_ring_turn(ring, a, b, d);
            int other = sides <= 0 ? polygon_ring_turn(ring, c, d, a) * polygon_ring_turn(ring, c, d, b) : 1;
            if (sides > 0 || other > 0)
                continue;
            if (sides < 0 && other < 0) {
                *first = a, *second = c;
                return true;
            }
            if (!ring->touches)
                ring->touch[0] = a, ring->touch[1] = c;
            ring->touches = true;
        }
    return false;
}

/* Is one of the edges of `piece` a line with all of `other` on its outer side? */
static bool is_parted_by(const PolygonRing *ring, const PolygonPiece *piece, const PolygonPiece *other)
{
    for (int i = 0; i < piece->count; i++) {
        int outside = 0, a = piece->corners[i], b = piece->corners[(i + 1) % piece->count];
        while (outside < other->count && polygon_ring_turn(ring, a, b, other->corners[outside]) <= 0)
            outside++;
        if (outside == other->count)
            return true;
    }
    return false;
}

bool polygon_ring_pieces_overlap(const PolygonRing *ring)
{
    const PolygonPiece *pieces = ring->pieces;
    for (int i = 0; i < ring->piece_count; i++)
        for (int k = 0; k < i; k++)
            if (!is_parted_by(ring, &pieces[i], &pieces[k]) && !is_parted_by(ring, &pieces[k], &pieces[i]))
                return true;
    return false;
}

/* Rounding to float32 may bend a corner inwards that is nearly straight, and shape.h allows 1/100 of the area then. */
static const double STRAIGHT = 1.0 / 50;

bool polygon_ring_is_quad(const PolygonRing *ring, const int *corners)
{
    Vec3 p[4];
    for (int i = 0; i < 4; i++)
        p[i] = ring->vertices[corners[i]].at;
    double area = vec3_dot(ring->normal, vec3_cross(vec3_sub(p[2], p[0]), vec3_sub(p[3], p[1])));
    for (int i = 0; i < 4; i++)
        if (!(point_left_of(ring->normal, p[i], p[(i + 1) % 4], p[(i + 2) % 4]) > STRAIGHT * area))
            return false;
    return area > 0 && shape_of(p, 4).verdict == SHAPE_GOOD;
}
