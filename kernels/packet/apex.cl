/* Rays through one point, the apex: the eye, an image of the eye in mirrors, or a light, from which shadow rays are told.
 * Seen from it, edge k of a face has the moment m = (v[k] - A) x (v[k+1] - v[k]), and a ray passes inside if all m . R have
 * one sign, without a hit point: three multiplications an edge. Its depth is as cheap, as 1/t = N.R / N.(v[0] - A).
 * What is within the error bounds of either is settled by geometry.cl and exact.cl.
 * docs/algorithm.md derives the bounds. */
#include "shared/compiler.cl"
#include "shared/layout.h"
#include "shared/precision.cl"
#include "packet/faces.cl"
#include "packet/lanes.cl"
#include "packet/vectors.cl"

typedef struct Apex {
    real x, y, z;
    real spread; /* no ray's line passes farther than this from the point */
    real length; /* no ray's direction is longer */
    real off;    /* twice how far the lines pass from x, y, z */
    real edge_share, edge_off, edge_floor; /* what FaceSetup.edge_error is made of */
} Apex;

INLINE Apex apex_at(const wide *point, real spread, real length)
{
    Apex a = {(real)point[0], (real)point[1], (real)point[2], spread, length};
    wide rounded = fabs(point[0] - (wide)a.x) + fabs(point[1] - (wide)a.y) + fabs(point[2] - (wide)a.z);
    a.off = 2 * (spread + (real)rounded) + REAL_FLOOR;
    a.edge_share = 16 * REAL_ROUNDING * length;
    a.edge_off = length * (a.off + 4 * REAL_ROUNDING * (fabs(a.x) + fabs(a.y) + fabs(a.z))); /* the latter for closed boxes */
    a.edge_floor = (1 + length) * REAL_FLOOR;
    return a;
}

/* The rays of a packet that come from an apex. */
typedef struct OriginPacket {
    Vec ahead;     /* from the apex along the ray: its direction; of a shadow ray the unit vector from the light */
    Lanes per_end; /* of a shadow ray: 1/t of its point; t is in units of `ahead`, from the apex */
    Lanes slack;   /* of a shadow ray: so many times a face's error bounds cover the errors of its direction and end, too */
    Mask active;   /* the lanes that take part in the search */
    Mask from;     /* the face that each ray leaves, which it does not hit again; -1: none */
} OriginPacket;

/* Of a packet without active rays. */
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

/* The slack of a shadow ray whose point may be off by that share of its length; and back again. */
#define SLACK_OF(share) (1 + (share) * (real)(0.25f / REAL_ROUNDING))
#define SHARE_OF(slack) (((slack) - 1) * (4 * REAL_ROUNDING))

/* A face as it is seen from an apex. */
typedef struct FaceSetup {
    real x[4], y[4], z[4]; /* the edges' moments, turned so that all m . R > 0 for a ray that meets the face ahead */
    real nx, ny, nz;       /* N / N.(v[0] - A) */
    real edge_error;       /* of m . ahead */
    real depth_error;      /* of 1/t */
    bool with_normal;      /* rays that hit it come from behind its normal */
    bool closed;           /* it is of a closed box of which every other face is left out */
} FaceSetup;

/* (v[k] - A) x (v[k+1] - v[k]) of the four edges. */
typedef struct EdgeMoments {
    real4 x, y, z;
} EdgeMoments;

/* x, y, z: of all v[k] - A. */
INLINE EdgeMoments edge_moments(global const real *row, real4 x, real4 y, real4 z)
{
    real4 vx = of_vertices(row, 0), vy = of_vertices(row, 1), vz = of_vertices(row, 2);
    real4 ex = vx.yzwx - vx, ey = vy.yzwx - vy, ez = vz.yzwx - vz;
    EdgeMoments m = {fma(y, ez, -z * ey), fma(z, ex, -x * ez), fma(x, ey, -y * ex)};
    return m;
}

typedef enum Visibility { CULLED, VISIBLE, UNCERTAIN } Visibility;

/* `towards`: the rays travel to the apex, not from it; one-sided faces let those through that come from behind the normal.
 * `outside`: the rays start and end outside of closed boxes, of which every other face is left out then: backs from the eye, from
 * a light the faces that are turned to it.
 * CULLED: no ray from the apex hits it. UNCERTAIN: the apex is so close to its plane that rounding may decide. */
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
    f->with_normal = height > 0;
    if (f->with_normal != reversed && (bits & FACE_BACK_OPEN || f->closed))
        return CULLED;
    EdgeMoments m = edge_moments(row, vx, vy, vz);
    real4 turn = (real4)(f->with_normal ? 1 : -1);
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

INLINE Lanes along(Vec ahead, real x, real y, real z) { return FMA(ahead.x, x, FMA(ahead.y, y, ahead.z * z)); }

/* The least m . ahead of the four edges. */
INLINE Lanes least_edge(Vec ahead, const REREAD FaceSetup *f)
{
    Lanes s0 = along(ahead, f->x[0], f->y[0], f->z[0]), s1 = along(ahead, f->x[1], f->y[1], f->z[1]);
    Lanes s2 = along(ahead, f->x[2], f->y[2], f->z[2]), s3 = along(ahead, f->x[3], f->y[3], f->z[3]);
    return LESSER(LESSER(s0, s1), LESSER(s2, s3));
}
