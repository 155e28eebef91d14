/* Where rays meet the planes of faces, and on which side of a plane points are, in `wide`.
 *
 *     t = -N.(O - v[0]) / N.R        height of a point P: N.(P - v[0])
 *
 * Each N.x is first computed in plain arithmetic, which has an error bound. Within the bound it is computed again with
 * pairs of wides (Ogita, Rump and Oishi, "Accurate Sum and Dot Product", 2005), and where even that is not enough,
 * exactly, by exact.cl. docs/bounds.md, section 3. */
#include "shared/compiler.cl"
#include "shared/exact.cl"
#include "shared/layout.h"
#include "shared/precision.cl"
#include "packet/faces.cl"
#include "packet/lanes.cl"
#include "packet/vectors.cl"
#include "packet/world.cl"

/* Whether t has to be as exact as `wide` can hold it. The float kernel with doubles needs less: plain arithmetic,
 * unless N.x is below ROUNDED_LIMIT times the sum of x's magnitudes. */
#define ROUNDED_IS_POOR (REAL_DOUBLE || !HAS_DOUBLE)
#define ROUNDED_LIMIT (wide)0x1p-20f

typedef struct PlaneRow {
    wide x, y, z;             /* N, rounded */
    wide low_x, low_y, low_z; /* what rounding took */
    wide error, length;       /* PLANE_ERROR, PLANE_LENGTH */
} PlaneRow;

INLINE PlaneRow plane_row(const World *world, int face)
{
    global const wide *row = world->planes + (size_t)face * PLANE_REALS;
    PlaneRow plane = {row[0], row[1], row[2], row[3], row[4], row[5], row[PLANE_ERROR], row[PLANE_LENGTH]};
    return plane;
}

/* P - v[0]. */
static WideVec from_vertex(global const real *row, WideVec point)
{
    WideVec d = {point.x - (wide)row[0], point.y - (wide)row[4], point.z - (wide)row[8]};
    return d;
}

/* N.x in plain arithmetic. Its error is at most ROUNDED_ERROR times the sum of x's magnitudes. With pairs it is
 * ACCURATE_ERROR. */
static Wide normal_dot(const PlaneRow *plane, WideVec x) { return plane->x * x.x + plane->y * x.y + plane->z * x.z; }

#define ROUNDED_ERROR(plane) ((plane).error + 8 * WIDE_ROUNDING)
#define ACCURATE_ERROR(plane) ((plane).error + 64 * WIDE_ROUNDING * WIDE_ROUNDING)

/* The exact values are high + low. */
typedef struct WidePair {
    Wide high, low;
} WidePair;

/* a + b and a b exactly, as two_sum and two_product in exact.cl do for one lane. */
static WidePair wide_sum(Wide a, Wide b)
{
    WidePair s;
    s.high = a + b;
    Wide b_seen = s.high - a;
    Wide a_seen = s.high - b_seen;
    s.low = (a - a_seen) + (b - b_seen);
    return s;
}

static WidePair wide_product(Wide a, Wide b)
{
    WidePair p;
    p.high = a * b;
    p.low = fma(a, b, -p.high);
    return p;
}

/* A vector: high + low. */
typedef struct WidePairs {
    WideVec high, low;
} WidePairs;

/* P - v[0]. */
static WidePairs from_vertex_exactly(global const real *row, WideVec point)
{
    WidePair x = wide_sum(point.x, (Wide)(-(wide)row[0]));
    WidePair y = wide_sum(point.y, (Wide)(-(wide)row[4]));
    WidePair z = wide_sum(point.z, (Wide)(-(wide)row[8]));
    WidePairs d = {{x.high, y.high, z.high}, {x.low, y.low, z.low}};
    return d;
}

/* Replaces N.x in the uncertain lanes by the exact M.x / |M|, where M is the cross product of the face's diagonals.
 * length: |M|. */
NOINLINE Wide resolve_dot_exactly(Wide value, global const real *row, wide length, const WidePairs *x,
                                  WideMask uncertain)
{
    wide v[LANES], high[3][LANES], low[3][LANES];
    WideMaskElement is_uncertain[LANES];
    STORE(value, v);
    STORE(x->high.x, high[0]);
    STORE(x->high.y, high[1]);
    STORE(x->high.z, high[2]);
    STORE(x->low.x, low[0]);
    STORE(x->low.y, low[1]);
    STORE(x->low.z, low[2]);
    STORE(uncertain, is_uncertain);
    for (int i = 0; i < LANES; i++)
        if (is_uncertain[i]) {
            Exact at = {{high[0][i], low[0][i]}, {high[1][i], low[1][i]}, {high[2][i], low[2][i]}};
            v[i] = cross_dot(row, &at) / length;
        }
    return LOAD(v);
}

/* N.x in twice the precision, as normal_dot_accurate in src/scene/geometry.c. */
static WidePair normal_dot_accurate(const PlaneRow *plane, global const real *row, const WidePairs *x, WideMask active)
{
    WideVec h = x->high, l = x->low;
    WidePair xs = wide_product((Wide)plane->x, h.x), ys = wide_product((Wide)plane->y, h.y);
    WidePair zs = wide_product((Wide)plane->z, h.z);
    WidePair xy = wide_sum(xs.high, ys.high), xyz = wide_sum(xy.high, zs.high);
    Wide low = xy.low + xyz.low + (xs.low + ys.low + zs.low) +
               ((plane->low_x * h.x + plane->low_y * h.y + plane->low_z * h.z) +
                (plane->x * l.x + plane->y * l.y + plane->z * l.z));
    WidePair value = wide_sum(xyz.high, low);
    Wide bound = ACCURATE_ERROR(*plane) * wide_magnitudes(h);
    WideMask uncertain = active & IS(fabs(value.high) <= PAIRS_LIMIT * bound);
    if (ANY(TO_MASK(uncertain))) {
        value.high = resolve_dot_exactly(value.high, row, plane->length, x, uncertain);
        value.low = uncertain ? (Wide)0 : value.low;
    }
    return value;
}

/* N.(point - v[0]). Its sign is exact in every active lane. */
static Wide plane_distance(const World *world, int face, const PlaneRow *plane, WideVec point, WideMask active)
{
    global const real *row = face_row(world, face);
    WideVec x = from_vertex(row, point);
    Wide value = normal_dot(plane, x);
    WideMask uncertain = active & IS(fabs(value) <= ROUNDED_ERROR(*plane) * wide_magnitudes(x));
    if (!ANY(TO_MASK(uncertain)))
        return value;
    WidePairs exactly = from_vertex_exactly(row, point);
    return resolve_dot_exactly(value, row, plane->length, &exactly, uncertain);
}

/* M.(point - v[0]): the sign is that of the distance. */
NOINLINE wide resolve_distance_exactly(global const real *row, const wide *point)
{
    wide corner[3];
    face_corner(row, 0, corner);
    Exact exactly = exact_difference(point, corner);
    return cross_dot(row, &exactly);
}

/* N.(point - v[0]) for one point of all lanes. Its sign is exact. */
INLINE wide plane_distance_of_point(const World *world, int face, const wide *point)
{
    global const real *row = face_row(world, face);
    global const wide *plane = world->planes + (size_t)face * PLANE_REALS;
    wide x = point[0] - (wide)row[0], y = point[1] - (wide)row[4], z = point[2] - (wide)row[8];
    wide value = plane[0] * x + plane[1] * y + plane[2] * z;
    wide bound = (plane[PLANE_ERROR] + 8 * WIDE_ROUNDING) * (fabs(x) + fabs(y) + fabs(z));
    return fabs(value) > bound ? value : resolve_distance_exactly(row, point);
}

/* Where rays meet a plane. */
typedef struct PlaneHit {
    Wide distance; /* N.(O - v[0]) */
    Wide t;
} PlaneHit;

/* t to half an ulp: one step of Newton's mends the quotient of the rounded values. */
NOINLINE void plane_hit_accurate(PlaneHit *hit, const PlaneRow *plane, global const real *row, const WideVec *origin,
                                 const WideVec *direction, WideMask active)
{
    WidePairs o = from_vertex_exactly(row, *origin), r = {*direction, {(Wide)0, (Wide)0, (Wide)0}};
    WidePair distance = normal_dot_accurate(plane, row, &o, active);
    WidePair approach = normal_dot_accurate(plane, row, &r, active);
    Wide q = distance.high / approach.high;
    Wide rest = fma(-q, approach.high, distance.high) + (distance.low - q * approach.low);
    hit->distance = distance.high;
    hit->t = -(IS(fabs(q) <= (Wide)WIDE_MAX) ? q + rest / approach.high : q);
}

/* Plain arithmetic leaves an error of some 2^-50 |O - v[0]| in N.(O - v[0]), and of 2^-50 |R| in N.R. That is nothing
 * to a float, unless the ray starts close to the plane or grazes it. Those rays, and all rays in double, take the
 * accurate way. */
static PlaneHit plane_hit(const World *world, int face, const WideVec *origin, const WideVec *direction,
                          WideMask active)
{
    PlaneRow plane = plane_row(world, face);
    PlaneHit hit;
    WideMask uncertain = active;
    if (!ROUNDED_IS_POOR) {
        WideVec x = from_vertex(face_row(world, face), *origin);
        Wide approach = normal_dot(&plane, *direction);
        hit.distance = normal_dot(&plane, x);
        hit.t = -hit.distance / approach;
        uncertain &= IS(fabs(hit.distance) <= ROUNDED_LIMIT * wide_magnitudes(x)) |
                     IS(fabs(approach) <= ROUNDED_LIMIT * wide_magnitudes(*direction));
    }
    if (ANY(TO_MASK(uncertain)))
        plane_hit_accurate(&hit, &plane, face_row(world, face), origin, direction, active);
    return hit;
}

/* The same for rays that start at one point. */
static PlaneHit plane_hit_from_point(const World *world, int face, const WideVec *origin, const WideVec *direction,
                                     WideMask active)
{
    if (ROUNDED_IS_POOR)
        return plane_hit(world, face, origin, direction, active);
    PlaneRow plane = plane_row(world, face);
    global const real *row = face_row(world, face);
    wide x = first_wide(origin->x) - row[0], y = first_wide(origin->y) - row[4], z = first_wide(origin->z) - row[8];
    wide distance = plane.x * x + plane.y * y + plane.z * z;
    Wide approach = normal_dot(&plane, *direction);
    if (fabs(distance) <= ROUNDED_LIMIT * (fabs(x) + fabs(y) + fabs(z)) ||
        ANY(TO_MASK(active & IS(fabs(approach) <= ROUNDED_LIMIT * wide_magnitudes(*direction)))))
        return plane_hit(world, face, origin, direction, active);
    PlaneHit hit = {(Wide)distance, -distance / approach};
    return hit;
}
