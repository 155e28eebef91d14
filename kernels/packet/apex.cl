/* Rays through one point, the apex A: the eye, an image of the eye in a mirror, or a light, from which shadow rays are
 * traced.
 *
 *     once per face:  m[k] = (v[k] - A) x (v[k+1] - v[k]) for each edge k,   n = N / N.(v[0] - A)
 *     for each ray:   inside if all m[k].R have one sign,   1/t = n.R
 *
 * The nearest face is the one with the largest 1/t. An edge takes three multiplications, and there is neither a hit
 * point nor a division. With tiles of 8 x 8 pixels that are searched together, this took a third from the time of
 * `original`, and a quarter from that of city-1k. Both values have error bounds, which docs/bounds.md derives in "Rays
 * through one point". intersect.cl decides what is within them. docs/kernels.md, section 4. */
#include "shared/compiler.cl"
#include "shared/layout.h"
#include "shared/precision.cl"
#include "packet/faces.cl"
#include "packet/lanes.cl"
#include "packet/vectors.cl"

typedef struct Apex {
    real x, y, z;
    real spread; /* no ray's line passes the exact point at a larger distance */
    real length; /* no ray's direction is longer */
    real off;    /* twice the largest distance from x, y, z at which lines pass */
    real edge_share, edge_off, edge_floor; /* what FaceSetup.edge_error is made of */
} Apex;

COMPILED_ONCE Apex apex_at(const wide *point, real spread, real length)
{
    Apex a = {(real)point[0], (real)point[1], (real)point[2], spread, length};
    wide rounded = fabs(point[0] - (wide)a.x) + fabs(point[1] - (wide)a.y) + fabs(point[2] - (wide)a.z);
    a.off = 2 * (spread + (real)rounded) + REAL_FLOOR;
    a.edge_share = 16 * REAL_ROUNDING * length;
    real closed_boxes = 4 * REAL_ROUNDING * (fabs(a.x) + fabs(a.y) + fabs(a.z));
    a.edge_off = length * (a.off + closed_boxes);
    a.edge_floor = (1 + length) * REAL_FLOOR;
    return a;
}

/* The rays of a packet that come from an apex. */
typedef struct OriginPacket {
    Vec ahead;     /* the direction R; of a shadow ray the unit vector from the light */
    Lanes per_end; /* of a shadow ray: 1/t of its point */
    Lanes slack;   /* of a shadow ray: error bounds of faces times this cover the error of its point, too */
    Mask active;   /* the lanes that take part in the search */
    Mask from;     /* the face that each ray leaves, which it does not hit again; -1: none */
} OriginPacket;

/* A packet without active rays. */
INLINE OriginPacket no_origin_packet(void)
{
    OriginPacket p = {{(Lanes)0, (Lanes)0, (Lanes)0}, (Lanes)0, (Lanes)1, (Mask)0, (Mask)-1};
    return p;
}

/* Shadow rays to the points, from the light. */
INLINE void aim_from_light(OriginPacket *p, const wide *light, WideVec point)
{
    Vec d = vec_to_real(wide_sub(point, wide_of(light)));
    p->per_end = 1 / sqrt(vec_dot(d, d));
    p->ahead = vec_scale(p->per_end, d);
    p->slack = (Lanes)1;
}

/* The slack of a shadow ray whose point may be off by a share of the ray's length, and the share of a slack. */
#define SLACK_OF(share) (1 + (share) * (real)(0.25f / REAL_ROUNDING))
#define SHARE_OF(slack) (((slack) - 1) * (4 * REAL_ROUNDING))

/* A face as seen from an apex. */
typedef struct FaceSetup {
    real x[4], y[4], z[4]; /* the m[k], turned so that all m[k].R > 0 for a ray that meets the face ahead */
    real nx, ny, nz;       /* n */
    real edge_error;       /* of m[k].R */
    real depth_error;      /* of 1/t */
    bool from_behind;      /* rays that hit it go along its normal: they come from behind */
    bool closed;           /* it belongs to a closed box, of which faces are culled */
} FaceSetup;

/* The m[k] of the four edges. */
typedef struct EdgeMoments {
    real4 x, y, z;
} EdgeMoments;

/* x, y, z: the coordinates of all v[k] - A. */
INLINE EdgeMoments edge_moments(global const real *row, real4 x, real4 y, real4 z)
{
    real4 vx = of_vertices(row, 0), vy = of_vertices(row, 1), vz = of_vertices(row, 2);
    real4 ex = vx.yzwx - vx, ey = vy.yzwx - vy, ez = vz.yzwx - vz;
    EdgeMoments m = {fma(y, ez, -z * ey), fma(z, ex, -x * ez), fma(x, ey, -y * ex)};
    return m;
}

typedef enum Visibility {
    CULLED,   /* no ray from the apex hits the face */
    VISIBLE,  /* it is set up */
    UNCERTAIN /* the apex is so close to the face's plane that rounding may decide */
} Visibility;

/* Sets up face i for rays from an apex. row: of the face. reversed: the rays travel to the apex, not from it.
 * One-sided faces let rays through that come from behind the normal. cull_boxes: the rays start and end outside of
 * closed boxes. Half of a box's faces are culled then: its backs as seen from the eye; as seen from a light, the faces
 * that are turned to it. */
INLINE Visibility setup_face(const Apex *a, global const real *row, bool reversed, bool cull_boxes, FaceSetup *f)
{
    uint bits = face_bits(row);
    f->closed = cull_boxes && bits & FACE_BACK_INSIDE;
    real4 vx = of_vertices(row, 0) - a->x, vy = of_vertices(row, 1) - a->y, vz = of_vertices(row, 2) - a->z;
    real nx = row[FACE_NORMAL], ny = row[FACE_NORMAL + 1], nz = row[FACE_NORMAL + 2];
    real x = nx * vx.x, y = ny * vy.x, z = nz * vz.x;
    real height = x + y + z;
    real slack = 8 * REAL_ROUNDING * (fabs(x) + fabs(y) + fabs(z)) + face_warp(bits) + a->off;
    if (!(fabs(height) > 4 * slack))
        return UNCERTAIN;
    f->from_behind = height > 0;
    if (f->from_behind != reversed && (bits & FACE_ONE_SIDED || f->closed))
        return CULLED;
    EdgeMoments m = edge_moments(row, vx, vy, vz);
    real4 turn = (real4)(f->from_behind ? 1 : -1);
    vstore4(turn * m.x, 0, f->x);
    vstore4(turn * m.y, 0, f->y);
    vstore4(turn * m.z, 0, f->z);
    if (bits & FACE_TRIANGLE) {
        f->x[3] = f->x[0];
        f->y[3] = f->y[0];
        f->z[3] = f->z[0];
    }
    real per_height = 1 / height, near = fabs(per_height);
    f->nx = nx * per_height;
    f->ny = ny * per_height;
    f->nz = nz * per_height;
    /* No vertex is farther from A than the first by more than two edges. */
    real edge = edge_bound(bits), size = fabs(vx.x) + fabs(vy.x) + fabs(vz.x) + 2 * edge;
    f->edge_error = edge * (a->edge_share * size + a->edge_off) + a->edge_floor;
    f->depth_error = a->length * near * (16 * REAL_ROUNDING + 2 * slack * near);
    return VISIBLE;
}

/* The dot product of the rays' directions with one vector. */
INLINE Lanes along(Vec ahead, real x, real y, real z) { return FMA(ahead.x, x, FMA(ahead.y, y, ahead.z * z)); }

/* The least m[k].R of the four edges. */
INLINE Lanes least_edge(Vec ahead, const REREAD FaceSetup *f)
{
    Lanes s0 = along(ahead, f->x[0], f->y[0], f->z[0]), s1 = along(ahead, f->x[1], f->y[1], f->z[1]);
    Lanes s2 = along(ahead, f->x[2], f->y[2], f->z[2]), s3 = along(ahead, f->x[3], f->y[3], f->z[3]);
    return LESSER(LESSER(s0, s1), LESSER(s2, s3));
}
