/* Beams and faces. Every function of the direction that is used here is linear, w.d: over the beam it lies between
 * w.c - |w.u| - |w.v| and w.c + |w.u| + |w.v|, both attained at corners. So the answers are exact but for rounding, and
 * BEAM_SLACK times the magnitudes that meet in a value bounds that. */
#include "trace/beam.h"

/* --- Making beams --- */

static Beam with_bounds(Beam beam)
{
    beam.width = vec3_magnitudes(beam.u) + vec3_magnitudes(beam.v);
    beam.length = vec3_magnitudes(beam.c) + beam.width;
    return beam;
}

Beam beam_of_pixel(const View *view, int column, int row)
{
    View whole = *view;
    whole.grid = 1;
    return with_bounds((Beam){
        .apex = view->eye,
        .c = view_direction(&whole, column, row, 0, 0),
        .u = vec3_scale(view->width / view->columns / 2, view->right),
        .v = vec3_scale(view->height / view->rows / 2, view->up),
        .size = vec3_magnitudes(view->eye),
    });
}

static Vec3 mirrored(Vec3 d, Vec3 n)
{
    return vec3_sub(d, vec3_scale(2 * vec3_dot(d, n), n));
}

Beam beam_mirrored(const Beam *beam, const Face *face, const Plane *plane)
{
    Vec3 n = plane->normal;
    double height = vec3_dot(n, vec3_sub(beam->apex, face_vertex(face, 0)));
    Vec3 apex = vec3_sub(beam->apex, vec3_scale(2 * height, n));
    double size = vec3_magnitudes(apex) + vec3_magnitudes(face_vertex(face, 0));
    return with_bounds((Beam){
        .apex = apex,
        .c = mirrored(beam->c, n),
        .u = mirrored(beam->u, n),
        .v = mirrored(beam->v, n),
        .size = beam->size > size ? beam->size : size,
        .mirrored = true,
    });
}

/* P = A + t d with t = -h/(N.d) lies in the direction P - X of X: as a multiple that is linear in d,
 * (-N.d)(A - X) + h d, with N turned to where h = N.(A - v0) > 0 > N.d. */
Beam beam_from_point(const Beam *beam, const Face *face, const Plane *plane, Vec3 x)
{
    Vec3 to_vertex = vec3_sub(beam->apex, face_vertex(face, 0)), from_x = vec3_sub(beam->apex, x), n = plane->normal;
    double height = vec3_dot(n, to_vertex);
    if (height < 0)
        n = vec3_negate(n);
    height = fabs(height);
    double grown = vec3_magnitudes(from_x) + vec3_magnitudes(to_vertex) + beam->size + vec3_magnitudes(x);
    return (Beam){
        .apex = x,
        .c = vec3_add(vec3_scale(-vec3_dot(n, beam->c), from_x), vec3_scale(height, beam->c)),
        .u = vec3_add(vec3_scale(-vec3_dot(n, beam->u), from_x), vec3_scale(height, beam->u)),
        .v = vec3_add(vec3_scale(-vec3_dot(n, beam->v), from_x), vec3_scale(height, beam->v)),
        .size = vec3_magnitudes(x),
        .length = grown * beam->length,
        .width = grown * beam->width,
    };
}

/* --- Linear functions of the direction --- */

typedef struct Range {
    double low, high;
} Range;

static Range range_of(const Beam *beam, Vec3 w)
{
    double middle = vec3_dot(w, beam->c), half = fabs(vec3_dot(w, beam->u)) + fabs(vec3_dot(w, beam->v));
    return (Range){middle - half, middle + half};
}

BeamPlane beam_plane(const Beam *beam, const Face *face, const Plane *plane)
{
    Vec3 x = vec3_sub(beam->apex, face_vertex(face, 0));
    double height = vec3_dot(plane->normal, x), slack = BEAM_SLACK * (beam->size + vec3_magnitudes(x));
    if (fabs(height) <= slack)
        return (BeamPlane){.error = HUGE_VAL, .side = beam->mirrored ? 0 : plane_side(face, plane, beam->apex)};
    Vec3 q = vec3_scale(1 / height, plane->normal);
    return (BeamPlane){q, vec3_magnitudes(q) * (BEAM_SLACK + slack / fabs(height)), height > 0 ? 1 : -1};
}

bool beam_is_farther(const Beam *beam, const BeamPlane *a, const BeamPlane *b)
{
    return range_of(beam, vec3_sub(a->q, b->q)).high < -(a->error + b->error) * beam->length;
}

/* --- Edges --- */

/* What the edges say: whether some has all of the beam on its left, on its right; and whether all do. The edge function
 * is (4.1) of docs/algorithm.md, for the direction d: left is where it is positive. */
typedef struct Edges {
    bool some_left, some_right, all_left, all_right;
} Edges;

static Edges edges_of(const Beam *beam, const Face *face)
{
    Edges edges = {false, false, true, true};
    for (int k = 0; k < face->vertex_count; k++) {
        Vec3 p = vec3_sub(face_vertex(face, k), beam->apex);
        Vec3 e = vec3_sub(face_vertex(face, (k + 1) % face->vertex_count), face_vertex(face, k));
        Range range = range_of(beam, vec3_cross(p, e));
        double error = BEAM_SLACK * (beam->size + vec3_magnitudes(p)) * vec3_magnitudes(e) * beam->length;
        bool left = range.low > error, right = range.high < -error;
        edges.some_left |= left;
        edges.some_right |= right;
        edges.all_left &= left;
        edges.all_right &= right;
    }
    return edges;
}

/* Where a corner p of a face is in the beam's own terms: p = l (c + a u + b v). Hence l det(u, v, c) = det(u, v, p),
 * and so on. error: of each of the three. */
typedef struct Corner {
    double l, la, lb, error;
} Corner;

/* Is the whole face on the outer side of a plane l a = m l with m >= 1? For m = 1 that is the side a = 1 of the beam
 * (sign 1); the larger m is, the more is the plane turned to where l = 0, away from the beam: a face that reaches
 * behind the apex may be beyond these alone. Likewise the side a = -1 (sign -1), and with lb for la the sides of b. */
static bool is_beyond(const Corner *corners, int count, bool is_a, double sign)
{
    double low = 0, high = HUGE_VAL; /* of m, by the corners behind and before the apex */
    for (int k = 0; k < count; k++) {
        double outward = sign * (is_a ? corners[k].la : corners[k].lb) - corners[k].error;
        double forward = corners[k].l + corners[k].error, m = outward / forward;
        if (forward >= 0 && !(outward > forward))
            return false;
        if (forward < 0)
            low = m > low ? m : low;
        else
            high = m < high ? m : high;
    }
    return low < high;
}

static bool beside(const Beam *beam, const Face *face)
{
    Vec3 uv = vec3_cross(beam->u, beam->v);
    double sign = vec3_dot(uv, beam->c) < 0 ? -1 : 1;
    Corner corners[4];
    for (int k = 0; k < face->vertex_count; k++) {
        Vec3 p = vec3_sub(face_vertex(face, k), beam->apex);
        corners[k].l = sign * vec3_dot(uv, p);
        corners[k].la = sign * vec3_dot(vec3_cross(p, beam->v), beam->c);
        corners[k].lb = sign * vec3_dot(vec3_cross(beam->u, p), beam->c);
        corners[k].error = BEAM_SLACK * (beam->size + vec3_magnitudes(p)) * beam->width * beam->length;
    }
    int count = face->vertex_count;
    return is_beyond(corners, count, true, 1) || is_beyond(corners, count, true, -1) ||
           is_beyond(corners, count, false, 1) || is_beyond(corners, count, false, -1);
}

BeamCover beam_cover(const Beam *beam, const Face *face, const BeamPlane *seen)
{
    Edges edges = edges_of(beam, face);
    bool outside = seen->side > 0   ? edges.some_left
                   : seen->side < 0 ? edges.some_right
                                    : edges.some_left && edges.some_right;
    bool inside = seen->side > 0 ? edges.all_right : seen->side < 0 && edges.all_left;
    return inside ? BEAM_FILLED : outside || beside(beam, face) ? BEAM_CLEAR : BEAM_CROSSED;
}
