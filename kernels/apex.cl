/* Rays through one point, the apex: the eye, an image of the eye in mirrors, or a light, from which shadow rays are told.
 * Seen from it, edge k of a face has the moment m = v[k] x v[k+1] + (v[k+1] - v[k]) x A, and a ray passes inside if all
 * m . R have one sign: half the arithmetic of a line in space, without a hit point. Its depth is as cheap, as
 * 1/t = -N.R / (N.A + D). What is within the error bounds of either is settled by geometry.cl and exact.cl.
 * docs/algorithm.md derives the bounds. */

typedef struct Apex {
    real x, y, z;
    real spread;  /* no ray's line passes farther than this from the point */
    real largest; /* no component of a ray's direction is larger */
} Apex;

INLINE Apex apex_at(const wide *point, real spread, real largest)
{
    Apex a = {(real)point[0], (real)point[1], (real)point[2], spread, largest};
    return a;
}

/* The rays of a packet that come from an apex. */
typedef struct Pencil {
    Vec ahead;     /* from the apex along the ray: its direction; of a shadow ray the unit vector from the light */
    Lanes per_end; /* of a shadow ray: 1/t of its point; t is in units of `ahead`, from the apex */
    Lanes doubt;   /* of a shadow ray: so many times the bounds of a face's errors cover those of its direction and its end, too */
    Mask active;   /* lanes that take part in the search that is on */
    Mask left;     /* the face that each ray leaves, not to be hit again */
} Pencil;

/* Of a packet without active rays. */
INLINE Pencil no_pencil(void)
{
    Pencil p = {{(Lanes)0, (Lanes)0, (Lanes)0}, (Lanes)0, (Lanes)1, (Mask)0, (Mask)-1};
    return p;
}

/* A shadow ray, told from the light. */
INLINE void aim_from_light(Pencil *p, const wide *light, WideVec point)
{
    Vec d = vec_to_real(wide_sub(point, wide_vec((Wide)light[0], (Wide)light[1], (Wide)light[2])));
    p->per_end = 1 / sqrt(vec_dot(d, d));
    p->ahead = vec_scale(p->per_end, d);
    p->doubt = (Lanes)1;
}

/* share: what the sketch that a shadow ray comes from may be off, of its length; and back again. */
#define DOUBT_OF(share) (1 + (share) * (real)(0.25f / REAL_ROUNDING))
#define SHARE_OF(doubt) (((doubt) - 1) * (4 * REAL_ROUNDING))

/* A face as it is seen from an apex. */
typedef struct ApexFace {
    real x[4], y[4], z[4]; /* the edges' moments, turned so that all m . R > 0 for a ray that meets the face ahead */
    real nx, ny, nz;       /* -N / (N.A + D) */
    real edge_error;       /* of m . ahead */
    real depth_error;      /* of 1/t */
    bool with_normal;      /* rays that hit it come from behind its normal */
    bool closed;           /* it is of a closed box of which every other face is left out */
} ApexFace;

typedef enum Sight { SIGHT_NONE, SIGHT_CLEAR, SIGHT_DOUBTFUL } Sight;

/* `towards`: the rays travel to the apex, not from it; one-sided faces let those through that come from behind the normal.
 * `outside`: the rays start and end outside of closed boxes, of which every other face is left out then: backs from the eye, from
 * a light the faces that are turned to it.
 * SIGHT_NONE: no ray from the apex hits it. SIGHT_DOUBTFUL: the apex is so close to its plane that rounding may decide. */
INLINE Sight see_face(const Apex *a, global const real *row, bool towards, bool outside, ApexFace *f)
{
    f->closed = outside && row[FACE_BACK_IS] == BACK_INSIDE;
    real nx = row[FACE_NORMAL], ny = row[FACE_NORMAL + 1], nz = row[FACE_NORMAL + 2], offset = row[FACE_OFFSET];
    real x = nx * a->x, y = ny * a->y, z = nz * a->z;
    real d = x + y + z + offset;
    real slack = 8 * REAL_ROUNDING * (fabs(x) + fabs(y) + fabs(z) + fabs(offset)) + row[FACE_WARP] + 2 * a->spread +
                 REAL_FLOOR;
    if (!(fabs(d) > 4 * slack))
        return SIGHT_DOUBTFUL;
    f->with_normal = d < 0;
    if (f->with_normal != towards && (row[FACE_BACK_IS] == BACK_OPEN || f->closed))
        return SIGHT_NONE;
    real4 turn = (real4)(f->with_normal ? 1 : -1);
    real4 ax = (real4)a->x, ay = (real4)a->y, az = (real4)a->z;
    real4 ex = vload4(0, row + EDGE_DIRECTION), ey = vload4(1, row + EDGE_DIRECTION), ez = vload4(2, row + EDGE_DIRECTION);
    vstore4(turn * fma(ey, az, fma(-ez, ay, vload4(0, row + EDGE_MOMENT))), 0, f->x);
    vstore4(turn * fma(ez, ax, fma(-ex, az, vload4(1, row + EDGE_MOMENT))), 0, f->y);
    vstore4(turn * fma(ex, ay, fma(-ey, ax, vload4(2, row + EDGE_MOMENT))), 0, f->z);
    real per_d = -1 / d;
    f->nx = nx * per_d;
    f->ny = ny * per_d;
    f->nz = nz * per_d;
    f->edge_error = a->largest * 16 * REAL_ROUNDING *
                        (row[FACE_MOMENT_BOUND] + (fabs(a->x) + fabs(a->y) + fabs(a->z)) * row[FACE_DIRECTION_BOUND]) +
                    a->largest * 2 * a->spread * row[FACE_DIRECTION_BOUND] + REAL_FLOOR;
    f->depth_error = a->largest * (fabs(f->nx) + fabs(f->ny) + fabs(f->nz)) * (16 * REAL_ROUNDING + 2 * slack * fabs(per_d));
    return SIGHT_CLEAR;
}

INLINE Lanes along(Vec ahead, real x, real y, real z) { return FMA(ahead.x, x, FMA(ahead.y, y, ahead.z * z)); }

/* The least m . ahead of the four edges. */
INLINE Lanes least_edge(Vec ahead, const ApexFace *f)
{
    Lanes s0 = along(ahead, f->x[0], f->y[0], f->z[0]), s1 = along(ahead, f->x[1], f->y[1], f->z[1]);
    Lanes s2 = along(ahead, f->x[2], f->y[2], f->z[2]), s3 = along(ahead, f->x[3], f->y[3], f->z[3]);
    return LESSER(LESSER(s0, s1), LESSER(s2, s3));
}
