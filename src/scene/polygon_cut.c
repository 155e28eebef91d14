/* Cutting a polygon: its normal, whether it is planar, whether it crosses itself, then strips or ears. */
#include "scene/polygon_cut.h"

#include "scene/polygon_ears.h"
#include "scene/shape.h"

#include <float.h>
#include <stdlib.h>

static const double PLANARITY = 1e-5;

int polygon_drop_repeats(const Vec3 *vertices, int *numbers, int count)
{
    int kept = 0;
    for (int i = 0; i < count; i++) {
        Vec3 a = vertices[numbers[i]], b = kept > 0 ? vertices[numbers[kept - 1]] : a;
        if (kept == 0 || a.x != b.x || a.y != b.y || a.z != b.z)
            numbers[kept++] = numbers[i];
    }
    for (; kept > 1; kept--) {
        Vec3 a = vertices[numbers[0]], b = vertices[numbers[kept - 1]];
        if (a.x != b.x || a.y != b.y || a.z != b.z)
            break;
    }
    return kept;
}

/* --- The ring --- */

static bool reserve(PolygonCut *cut, int count, Error *error)
{
    PolygonRing *ring = &cut->ring;
    if (count <= cut->capacity)
        return true;
    PolygonVertex *vertices = realloc(ring->vertices, (size_t)count * sizeof *vertices);
    ring->vertices = vertices ? vertices : ring->vertices;
    PolygonPiece *pieces = realloc(ring->pieces, (size_t)count * sizeof *pieces);
    ring->pieces = pieces ? pieces : ring->pieces;
    if (!vertices || !pieces)
        return error_memory(error, "a polygon");
    cut->capacity = count;
    return true;
}

/* The numbers of a scene may be large: they are scaled by a power of two, which rounds nothing, to less than 1. */
static int begin_ring(PolygonRing *ring, const Vec3 *vertices, int count)
{
    double size = 0;
    for (int i = 0; i < count; i++)
        size = fmax(size, vec3_largest(vertices[i]));
    int exponent = vec3_exponent(vec3(size, 0, 0));
    for (int i = 0; i < count; i++)
        ring->vertices[i] = (PolygonVertex){
            .at = vec3_ldexp(vertices[i], -exponent),
            .next = (i + 1) % count,
            .previous = (i + count - 1) % count,
            .beyond = -1,
        };
    return exponent;
}

static Vec3 from_first(const PolygonRing *ring, int i)
{
    return vec3_sub(ring->vertices[i].at, ring->vertices[0].at);
}

/* Twice the area that rounding errors of an ulp in each coordinate can give to a polygon: they move its boundary. */
static double area_noise(const PolygonRing *ring)
{
    double around = 0;
    for (int i = 0; i < ring->count; i++)
        around += vec3_length(vec3_sub(ring->vertices[ring->vertices[i].next].at, ring->vertices[i].at));
    return 16 * DBL_EPSILON * around;
}

/* Newell's normal, twice the area long. */
static Vec3 normal_around(const PolygonRing *ring)
{
    Vec3 sum = vec3(0, 0, 0);
    for (int i = 2; i < ring->count; i++)
        sum = vec3_add(sum, vec3_cross(from_first(ring, i - 1), from_first(ring, i)));
    return sum;
}

/* The normal of the largest triangle on the longest line from vertex 0: zero for vertices on a line. */
static Vec3 normal_of_largest(const PolygonRing *ring)
{
    Vec3 longest = vec3(0, 0, 0), normal = longest;
    for (int i = 1; i < ring->count; i++)
        if (vec3_length(from_first(ring, i)) > vec3_length(longest))
            longest = from_first(ring, i);
    for (int i = 1; i < ring->count; i++) {
        Vec3 other = vec3_cross(longest, from_first(ring, i));
        if (vec3_length(other) > vec3_length(normal))
            normal = other;
    }
    return normal;
}

/* Places the vertices in the plane, in axes of its own. */
static void flatten(PolygonRing *ring, Vec3 normal)
{
    Vec3 n = vec3_unit(normal), a = vec3(fabs(n.x), fabs(n.y), fabs(n.z));
    Vec3 axis = vec3(a.x <= a.y && a.x <= a.z, a.y < a.x && a.y <= a.z, a.z < a.x && a.z < a.y);
    Vec3 u = vec3_unit(vec3_cross(axis, n)), v = vec3_cross(n, u);
    ring->normal = n;
    ring->margin = 64 * DBL_EPSILON; /* of coordinates below 1 */
    for (int i = 0; i < ring->count; i++) {
        ring->vertices[i].u = vec3_dot(u, ring->vertices[i].at);
        ring->vertices[i].v = vec3_dot(v, ring->vertices[i].at);
    }
}

/* --- Verdicts --- */

static double size_of(const PolygonRing *ring)
{
    if (ring->count == 4) {
        Vec3 other = vec3_sub(ring->vertices[3].at, ring->vertices[1].at);
        return fmax(vec3_length(from_first(ring, 2)), vec3_length(other));
    }
    Vec3 low = vec3(0, 0, 0), high = low;
    for (int i = 1; i < ring->count; i++) {
        Vec3 p = from_first(ring, i);
        low = vec3(fmin(low.x, p.x), fmin(low.y, p.y), fmin(low.z, p.z));
        high = vec3(fmax(high.x, p.x), fmax(high.y, p.y), fmax(high.z, p.z));
    }
    return vec3_length(vec3_sub(high, low));
}

/* A point of the plane, from vertex 0: the middle of the vertices, of a quad vertex 0. */
static Vec3 middle_of(const PolygonRing *ring)
{
    Vec3 sum = vec3(0, 0, 0);
    for (int i = 1; i < ring->count && ring->count > 4; i++)
        sum = vec3_add(sum, from_first(ring, i));
    return vec3_scale(1.0 / ring->count, sum);
}

static bool is_planar(PolygonCut *cut, int exponent)
{
    const PolygonRing *ring = &cut->ring;
    double size = size_of(ring), farthest = 0;
    Vec3 middle = middle_of(ring);
    for (int i = 0; i < ring->count; i++) {
        double distance = fabs(vec3_dot(ring->normal, vec3_sub(from_first(ring, i), middle)));
        if (distance > farthest) {
            farthest = distance;
            cut->first = i;
        }
    }
    cut->distance = ldexp(farthest, exponent);
    cut->size = ldexp(size, exponent);
    return farthest <= PLANARITY * size;
}

/* A quad that is no fold along either of its diagonals: on both the triangles turn against each other. */
static bool is_twisted(const PolygonRing *ring)
{
    Vec3 a = from_first(ring, 1), b = from_first(ring, 2), c = from_first(ring, 3), ab = vec3_sub(b, a);
    Vec3 ac = vec3_sub(c, a);
    return vec3_dot(vec3_cross(a, b), vec3_cross(b, c)) < 0 && vec3_dot(vec3_cross(ab, ac), vec3_cross(a, ac)) < 0;
}

/* --- Convex polygons --- */

static bool is_convex(const PolygonRing *ring)
{
    for (int i = 0; i < ring->count; i++)
        if (polygon_ring_turn(ring, ring->vertices[i].previous, i, ring->vertices[i].next) < 0)
            return false;
    return !ring->touches;
}

static bool add_triangle(PolygonRing *ring, int a, int b, int c)
{
    ring->pieces[ring->piece_count++] = (PolygonPiece){.corners = {a, b, c}, .count = 3};
    return polygon_ring_turn(ring, a, b, c) > 0;
}

/* Cuts a convex polygon into strips across it, half as many as it has vertices. Fails where one would have no area. */
static bool cut_strips(PolygonRing *ring)
{
    int low = 0, high = ring->count - 1;
    bool good = true;
    for (; good && high - low > 2; low++, high--) {
        const int quad[4] = {low, low + 1, high - 1, high};
        if (polygon_ring_is_quad(ring, quad))
            ring->pieces[ring->piece_count++] =
                (PolygonPiece){.corners = {quad[0], quad[1], quad[2], quad[3]}, .count = 4};
        else
            good = add_triangle(ring, quad[0], quad[1], quad[2]) && add_triangle(ring, quad[0], quad[2], quad[3]);
    }
    if (good && high - low == 2)
        good = add_triangle(ring, low, low + 1, high);
    if (!good)
        ring->piece_count = 0;
    return good;
}

/* --- All together --- */

/* Turns the corners of each piece until the first is the one that comes first in the polygon. */
static void put_first_corners_first(PolygonRing *ring)
{
    for (int i = 0; i < ring->piece_count; i++) {
        const PolygonPiece piece = ring->pieces[i];
        int first = 0;
        for (int k = 1; k < piece.count; k++)
            if (piece.corners[k] < piece.corners[first])
                first = k;
        for (int k = 0; k < piece.count; k++)
            ring->pieces[i].corners[k] = piece.corners[(first + k) % piece.count];
    }
}

static bool cut_as_it_is(PolygonRing *ring, const Vec3 *vertices, int count)
{
    if (count > 4 || shape_of(vertices, count).verdict != SHAPE_GOOD)
        return false;
    ring->pieces[ring->piece_count++] = (PolygonPiece){.corners = {0, 1, 2, 3}, .count = count};
    return true;
}

static PolygonVerdict crossed(PolygonCut *cut, int first, int second)
{
    cut->first = first;
    cut->second = second;
    return POLYGON_CROSSED;
}

static PolygonVerdict verdict_on(PolygonCut *cut, int exponent, bool bent)
{
    PolygonRing *ring = &cut->ring;
    Vec3 normal = normal_around(ring);
    double noise = area_noise(ring);
    bool no_area = vec3_length(normal) <= noise; /* or the areas of a bow-tie cancel */
    if (no_area)
        normal = normal_of_largest(ring);
    if (vec3_length(normal) <= noise)
        return POLYGON_NO_AREA;
    flatten(ring, normal);
    int first, second;
    cut->is_bent = !is_planar(cut, exponent);
    if (cut->is_bent && !bent && !no_area)
        return POLYGON_NOT_PLANAR;
    if (cut->is_bent && ring->count == 4 && is_twisted(ring)) /* along the normal it may look like anything */
        flatten(ring, normal_of_largest(ring));
    if (polygon_ring_crosses(ring, &first, &second))
        return crossed(cut, first, second);
    if (ring->count > 4 && is_convex(ring) && cut_strips(ring))
        return POLYGON_GOOD;
    if (!polygon_ears_cut(ring) || (ring->touches && polygon_ring_pieces_overlap(ring)))
        return crossed(cut, ring->touch[0], ring->touch[1]);
    return no_area || ring->piece_count == 0 ? POLYGON_NO_AREA : POLYGON_GOOD;
}

bool polygon_cut(PolygonCut *cut, const Vec3 *vertices, int count, bool bent, Error *error)
{
    PolygonRing *ring = &cut->ring;
    if (!reserve(cut, count, error))
        return false;
    *ring =
        (PolygonRing){.count = count, .left = count, .fold = -1, .vertices = ring->vertices, .pieces = ring->pieces};
    cut->verdict = POLYGON_GOOD;
    cut->is_bent = false;
    if (!cut_as_it_is(ring, vertices, count))
        cut->verdict = verdict_on(cut, begin_ring(ring, vertices, count), bent);
    if (cut->verdict)
        ring->piece_count = 0;
    put_first_corners_first(ring);
    return true;
}

void polygon_cut_free(PolygonCut *cut)
{
    free(cut->ring.vertices);
    free(cut->ring.pieces);
    *cut = (PolygonCut){0};
}
