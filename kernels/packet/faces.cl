/* What the rows of a face say; shared/layout.h has their columns. */
#include "shared/compiler.cl"
#include "shared/layout.h"
#include "shared/precision.cl"
#include "packet/lanes.cl"
#include "packet/vectors.cl"
#include "packet/world.cl"

INLINE global const real *face_row(const World *world, int face)
{
    return world->face_rows + (size_t)face * FACE_REALS;
}

INLINE Vec face_vertex(global const real *row, int k)
{
    return vec((Lanes)row[k], (Lanes)row[4 + k], (Lanes)row[8 + k]);
}

/* One coordinate of all four vertices. */
INLINE real4 of_vertices(global const real *row, int axis)
{
    return *(global const real4 *)(row + FACE_VERTICES + 4 * axis);
}

INLINE uint face_bits(global const real *row) { return *(global const uint *)(row + FACE_BITS); }

INLINE int face_material(const World *world, int face) { return world->faces[face].material & ~FACE_FLAT; }
INLINE bool face_is_flat(const World *world, int face) { return world->faces[face].material & FACE_FLAT; }

/* No edge has a larger |x| + |y| + |z|; no vertex is farther from the plane. bits: of face_bits. */
INLINE real edge_bound(uint bits) { return (real)fabs(as_float(bits)); }
INLINE real face_warp(uint bits) { return (real)fabs(as_float(bits << 16)); }

/* |x| + |y| + |z| of the first vertex. */
INLINE real vertex_magnitudes(const World *world, int face)
{
    global const real *v = face_row(world, face) + FACE_VERTICES;
    return fabs(v[0]) + fabs(v[4]) + fabs(v[8]);
}
