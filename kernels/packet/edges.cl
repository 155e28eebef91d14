/* Does a ray pass inside the edges of a face? (Kensler and Shirley, "Optimizing Ray-Triangle Intersection via
 * Automated Search", 2006, have the same determinants.)
 *
 *     s[k] = det(R, v[k] - O, v[k+1] - O) for each edge k
 *     inside along the normal: all s[k] >= 0;  inside against it: all s[k] <= 0
 *
 * A fast test in `real` has a proved error bound, which decides nearly every lane. exact.cl decides the few whose s[k]
 * are within it. No hit point is needed, and no ray slips between two faces that share an edge. docs/bounds.md derives
 * the bound in "The edge filter". */
#include "shared/compiler.cl"
#include "shared/exact.cl"
#include "shared/layout.h"
#include "shared/precision.cl"
#include "packet/faces.cl"
#include "packet/lanes.cl"
#include "packet/rays.cl"
#include "packet/vectors.cl"

/* Rays against the edges of one face. */
typedef struct EdgeTest {
    Mask may;         /* lanes that may pass inside, */
    Mask sure;        /* that certainly do, */
    Mask from_behind; /* and that do along the normal, from behind the face */
} EdgeTest;

/* s[k] = R.(a x (v[k+1] - v[k])), which is the determinant above. a: v[k] - O; v: row + k, w: row + k + 1. */
INLINE Lanes edge_function(Vec r, Vec a, global const real *v, global const real *w)
{
    real x = w[0] - v[0], y = w[4] - v[4], z = w[8] - v[8];
    return FMA(r.x, FMA(a.y, z, -a.z * y), FMA(r.y, FMA(a.z, x, -a.x * z), r.z * FMA(a.x, y, -a.y * x)));
}

INLINE EdgeTest test_edges(const RealRay *l, global const real *row)
{
    uint bits = face_bits(row);
    int edges = bits & FACE_TRIANGLE ? 3 : 4;
    Vec first = vec_sub(face_vertex(row, 0), l->origin);
    Lanes low = edge_function(l->direction, first, row, row + 1), high = low;
    for (int k = 1; k < edges; k++) {
        Vec a = vec_sub(face_vertex(row, k), l->origin);
        Lanes s = edge_function(l->direction, a, row + k, row + (k + 1 & 3));
        low = LESSER(low, s);
        high = GREATER(high, s);
    }
    /* No vertex is farther from O than the first by more than two edges. */
    Lanes size = vec_magnitudes(first) + vec_magnitudes(l->origin) + 2 * edge_bound(bits);
    Lanes bound = l->scale * FMA(size, 16 * REAL_ROUNDING * edge_bound(bits), REAL_FLOOR) + REAL_FLOOR;
    EdgeTest test;
    test.from_behind = IS(low > bound);
    test.sure = test.from_behind | IS(high < -bound);
    test.may = IS(low >= -bound) | IS(high <= bound);
    return test;
}

/* Decides the lanes that may pass inside, but not surely. target: where all rays end; NULL: they have no end. */
NOINLINE void resolve_edges_exactly(EdgeTest *test, global const real *row, const Ray *ray, const wide *target)
{
    MaskElement may[LANES], sure[LANES], from_behind[LANES];
    wide o[3][LANES], r[3][LANES];
    STORE(test->may, may);
    STORE(test->sure, sure);
    STORE(test->from_behind, from_behind);
    STORE(ray->origin.x, o[0]);
    STORE(ray->origin.y, o[1]);
    STORE(ray->origin.z, o[2]);
    STORE(ray->direction.x, r[0]);
    STORE(ray->direction.y, r[1]);
    STORE(ray->direction.z, r[2]);
    for (int i = 0; i < LANES; i++) {
        if (!may[i] || sure[i])
            continue;
        wide origin[3] = {o[0][i], o[1][i], o[2][i]};
        wide zero[3] = {0, 0, 0};
        wide direction[3] = {r[0][i], r[1][i], r[2][i]};
        Exact exact = target ? exact_difference(target, origin) : exact_difference(direction, zero);
        int sign = inside_sign(row, origin, &exact);
        may[i] = sign ? -1 : 0;
        from_behind[i] = sign > 0 ? -1 : 0;
    }
    test->may = LOAD(may);
    test->from_behind = LOAD(from_behind);
}
