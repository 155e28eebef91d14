/* Linear functions of the direction over beams, and the depths of planes, which are such functions. */
#include "shared/compiler.cl"
#include "shared/precision.cl"
#include "packet/lanes.cl"
#include "packet/planes.cl"
#include "packet/world.cl"
#include "adaptive/beam.cl"
#include "adaptive/point.cl"

/* A linear function w.d over a beam. It lies between w.c - extent and w.c + extent. Its error is `error` for each unit
 * of a lane's length, and `rounding`, which comes from `real`, for each unit of the lane's direction. */
typedef struct Linear {
    real x, y, z;
    real extent, error, rounding;
} Linear;

/* w itself is known but for `error`. */
INLINE Linear linear_over(const Beam *b, Point w, wide error)
{
    Linear f = {(real)w.x, (real)w.y, (real)w.z, (real)(fabs(point_dot(w, b->u)) + fabs(point_dot(w, b->v))),
                (real)error, (real)(REAL_SLACK * point_magnitudes(w))};
    return f;
}

INLINE Lanes along_c(const BeamLanes *b, const Linear *f)
{
    return f->x * b->real_c.x + f->y * b->real_c.y + f->z * b->real_c.z;
}

INLINE Lanes linear_error(const BeamLanes *b, const Linear *f)
{
    return f->error * b->length + f->rounding * b->real_length;
}

/* A plane as a beam meets it. */
typedef struct BeamPlane {
    Point q;    /* 1/t is q.d */
    wide error; /* of q; WIDE_MAX: the apex is too close to the plane */
    int side;   /* of the apex: 1: the normal's; -1: the other; 0: it lies in the plane, or that is uncertain */
} BeamPlane;

NOINLINE BeamPlane beam_plane(const World *world, const Beam *beam, int face)
{
    Point n = face_normal(world, face), x = point_sub(beam->apex, face_point(world, face, 0));
    wide height = point_dot(n, x), slack = BEAM_SLACK(beam) * (beam->size + point_magnitudes(x));
    BeamPlane plane = {{0, 0, 0}, WIDE_MAX, 0};
    if (fabs(height) <= slack) {
        wide apex[3] = {beam->apex.x, beam->apex.y, beam->apex.z};
        wide distance = beam->mirrored ? 0 : plane_distance_of_point(world, face, apex);
        plane.side = distance > 0 ? 1 : distance < 0 ? -1 : 0;
        return plane;
    }
    plane.q = point_scale(1 / height, n);
    plane.error = point_magnitudes(plane.q) * (BEAM_SLACK(beam) + slack / fabs(height));
    plane.side = height > 0 ? 1 : -1;
    return plane;
}

/* A function that is negative where plane b lies farther along all of the pixel's beam than plane a. False: there is no
 * such function. */
INLINE bool farther_plane(const Beam *beam, const BeamPlane *a, const BeamPlane *b, Linear *f)
{
    if (a->error == WIDE_MAX || b->error == WIDE_MAX)
        return false;
    *f = linear_over(beam, point_sub(a->q, b->q), a->error + b->error);
    return true;
}

INLINE Mask is_negative(const BeamLanes *b, const Linear *f)
{
    return IS(along_c(b, f) + f->extent < -linear_error(b, f));
}
