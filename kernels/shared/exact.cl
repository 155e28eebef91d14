/* Signs without rounding, for the rare values that lie within their rounding error of zero (Shewchuk, "Adaptive
 * Precision Floating-Point Arithmetic and Fast Robust Geometric Predicates", 1997).
 *
 *     compute the determinant in `wide`, and its error bound
 *     beyond the bound its sign is certain
 *     within it: multiply out the determinant, and add up its terms as an expansion, a sum of wides without rounding
 *
 * An expansion takes some thousand operations, one lane at a time. Nearly no ray needs one; those that do would see a
 * gap between two faces without it. docs/bounds.md, "The sign of a determinant". */
#include "shared/compiler.cl"
#include "shared/layout.h"
#include "shared/precision.cl"

/* The exact value is high + low. */
typedef struct Pair {
    wide high, low;
} Pair;

/* A vector in twice the precision of `wide`. */
typedef struct Exact {
    Pair x, y, z;
} Exact;

/* A determinant of three vectors is a sum of 6 products, each of three pairs: of 8 products of wides, each 4 wides
 * long. */
enum { EXPANSION_TERMS = 6 * 8 * 4 };

/* a + b exactly (Knuth, The Art of Computer Programming, volume 2, section 4.2.2). */
INLINE Pair two_sum(wide a, wide b)
{
    Pair s;
    s.high = a + b;
    wide b_seen = s.high - a;
    wide a_seen = s.high - b_seen;
    s.low = (a - a_seen) + (b - b_seen);
    return s;
}

/* a b exactly. */
INLINE Pair two_product(wide a, wide b)
{
    Pair p;
    p.high = a * b;
    p.low = fma(a, b, -p.high);
    return p;
}

static Exact exact_difference(const wide *a, const wide *b)
{
    Exact d;
    d.x = two_sum(a[0], -b[0]);
    d.y = two_sum(a[1], -b[1]);
    d.z = two_sum(a[2], -b[2]);
    return d;
}

/* Adds a value to an expansion of `count` terms, the smallest first. Returns how many there are then. */
static int expansion_add(wide *terms, int count, wide value)
{
    int kept = 0;
    for (int i = 0; i < count; i++) {
        Pair s = two_sum(value, terms[i]);
        value = s.high;
        if (s.low != 0)
            terms[kept++] = s.low;
    }
    if (value != 0)
        terms[kept++] = value;
    return kept;
}

/* Adds sign a b c. */
static int expansion_add_product(wide *terms, int count, wide sign, Pair a, Pair b, Pair c)
{
    for (int i = 0; i < 8; i++) {
        wide u = sign * (i & 1 ? a.high : a.low), v = i & 2 ? b.high : b.low, w = i & 4 ? c.high : c.low;
        if (u == 0 || v == 0 || w == 0)
            continue;
        Pair uv = two_product(u, v);
        Pair low = two_product(uv.low, w), high = two_product(uv.high, w);
        count = expansion_add(terms, count, low.low);
        count = expansion_add(terms, count, low.high);
        count = expansion_add(terms, count, high.low);
        count = expansion_add(terms, count, high.high);
    }
    return count;
}

/* det(a, b, c) = a . (b x c), to within an ulp or two. Its sign is exact. */
NOINLINE wide exact_determinant(const Exact *a, const Exact *b, const Exact *c)
{
    wide terms[EXPANSION_TERMS];
    int count = 0;
    count = expansion_add_product(terms, count, 1, a->x, b->y, c->z);
    count = expansion_add_product(terms, count, -1, a->x, b->z, c->y);
    count = expansion_add_product(terms, count, 1, a->y, b->z, c->x);
    count = expansion_add_product(terms, count, -1, a->y, b->x, c->z);
    count = expansion_add_product(terms, count, 1, a->z, b->x, c->y);
    count = expansion_add_product(terms, count, -1, a->z, b->y, c->x);
    wide value = 0;
    for (int i = 0; i < count; i++)
        value += terms[i];
    return value;
}

/* The sign of det(a, b, c): -1, 0 or 1. */
NOINLINE int determinant_sign(const Exact *a, const Exact *b, const Exact *c)
{
    wide yz = b->y.high * c->z.high, zy = b->z.high * c->y.high;
    wide zx = b->z.high * c->x.high, xz = b->x.high * c->z.high;
    wide xy = b->x.high * c->y.high, yx = b->y.high * c->x.high;
    wide value = a->x.high * (yz - zy) + a->y.high * (zx - xz) + a->z.high * (xy - yx);
    wide magnitude = fabs(a->x.high) * (fabs(yz) + fabs(zy)) + fabs(a->y.high) * (fabs(zx) + fabs(xz)) +
                     fabs(a->z.high) * (fabs(xy) + fabs(yx));
    if (fabs(value) <= 10 * WIDE_ROUNDING * magnitude)
        value = exact_determinant(a, b, c);
    return (value > 0) - (value < 0);
}

INLINE void face_corner(global const real *row, int k, wide *corner)
{
    for (int axis = 0; axis < 3; axis++)
        corner[axis] = (wide)row[FACE_VERTICES + 4 * axis + k];
}

/* How a ray passes the face inside its four edges: 1 along the normal, -1 against it, 0 not at all. */
NOINLINE int inside_sign(global const real *row, const wide *origin, const Exact *direction)
{
    int lowest = 1, highest = -1;
    for (int k = 0; k < 4; k++) {
        wide a[3], b[3];
        face_corner(row, k, a);
        face_corner(row, (k + 1) & 3, b);
        if (a[0] == b[0] && a[1] == b[1] && a[2] == b[2])
            continue; /* a triangle has three edges */
        Exact p = exact_difference(a, origin), q = exact_difference(b, origin);
        int sign = determinant_sign(direction, &p, &q);
        lowest = min(lowest, sign);
        highest = max(highest, sign);
    }
    return lowest >= 0 && highest > 0 ? 1 : highest <= 0 && lowest < 0 ? -1 : 0;
}

/* M.x, where M is the cross product of the face's diagonals: its normal, but for its length. */
NOINLINE wide cross_dot(global const real *row, const Exact *x)
{
    wide v[4][3];
    for (int k = 0; k < 4; k++)
        face_corner(row, k, v[k]);
    Exact a = exact_difference(v[2], v[0]), b = exact_difference(v[3], v[1]);
    return exact_determinant(x, &a, &b);
}
