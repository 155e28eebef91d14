/* Beams. A beam is all rays of a pixel at once: the directions c + a u + b v, for a and b between -1 and 1 (Heckbert
 * and Hanrahan, "Beam Tracing Polygonal Objects", 1984). Each lane of each packet has another pixel's beam.
 *
 *     a linear function w.d of the direction lies, over the beam, between w.c - |w.u| - |w.v| and w.c + |w.u| + |w.v|
 *     a mirror makes of the beam its image; from a light, the way to a patch is a beam again
 *
 * The pixels of a group see the same faces in the same order. So their beams share all but the middle direction c, and
 * nearly all arithmetic on a face is scalar. The operations are those of src/trace/beam.c, in the same order. */
#include "shared/compiler.cl"
#include "shared/precision.cl"
#include "packet/lanes.cl"
#include "packet/vectors.cl"
#include "packet/world.cl"
#include "adaptive/point.cl"

/* What is a pixel's own, lane by lane. */
typedef struct BeamLanes {
    WideVec c;
    Vec real_c;
    Lanes length;      /* as in src/trace/beam.h */
    Lanes real_length; /* of the direction alone, as it is */
} BeamLanes;

typedef struct Beam {
    Point apex, u, v;
    Point c0;                  /* the c of one pixel of the group */
    wide middle[2], extent[2]; /* in units of u and v, all beams lie between c0 + middle -+ extent */
    wide size, width, length;  /* length: no less than that of each lane */
    bool mirrored;
    int rounded; /* see BEAM_SLACK */
    BeamLanes lanes[PACKETS];
} Beam;

/* WIDE_SLACK for what is computed from a beam. In double it is enough for all mirrors of a path. In float a mirror adds
 * its rounding, less than twice as much, and so does a point that a beam is made from, less than once as much. */
#if REAL_DOUBLE || HAS_DOUBLE
#define BEAM_SLACK(beam) WIDE_SLACK
#else
#define BEAM_SLACK(beam) (WIDE_SLACK * (1 + (beam)->rounded))
#endif

INLINE Wide wide_times(Point w, WideVec d) { return (Wide)w.x * d.x + (Wide)w.y * d.y + (Wide)w.z * d.z; }

INLINE WideVec wide_point(Point p) { return wide_vec((Wide)p.x, (Wide)p.y, (Wide)p.z); }

INLINE void beam_bounds(Beam *b)
{
    b->width = point_magnitudes(b->u) + point_magnitudes(b->v);
    b->length = point_magnitudes(b->c0) + 2 * (b->extent[0] + b->extent[1]) * b->width;
    EACH_PACKET(k) {
        BeamLanes *lanes = b->lanes + k;
        lanes->real_c = vec_to_real(lanes->c);
        lanes->length = lanes->real_length = TO_REAL(wide_magnitudes(lanes->c) + b->width);
    }
}

/* The image of a vector in a plane with that normal. */
INLINE Point point_mirrored(Point d, Point n) { return point_sub(d, point_scale(2 * point_dot(d, n), n)); }

/* Makes of the beams their images in the plane of a face. */
static void beam_mirror(const World *world, Beam *beam, int face)
{
    Point n = face_normal(world, face), corner = face_point(world, face, 0);
    wide height = point_dot(n, point_sub(beam->apex, corner));
    beam->apex = point_sub(beam->apex, point_scale(2 * height, n));
    beam->u = point_mirrored(beam->u, n);
    beam->v = point_mirrored(beam->v, n);
    beam->c0 = point_mirrored(beam->c0, n);
    EACH_PACKET(k) {
        WideVec c = beam->lanes[k].c;
        beam->lanes[k].c = wide_sub(c, wide_scale(2 * wide_times(n, c), wide_point(n)));
    }
    wide size = point_magnitudes(beam->apex) + point_magnitudes(corner);
    beam->size = beam->size > size ? beam->size : size;
    beam->mirrored = true;
    beam->rounded += 2;
    beam_bounds(beam);
}

/* The beams from a point x to where the given beams meet the plane of a face. */
NOINLINE void beam_from_point(const World *world, const Beam *beam, int face, Point x, Beam *b)
{
    Point to_vertex = point_sub(beam->apex, face_point(world, face, 0)), from_x = point_sub(beam->apex, x);
    Point n = face_normal(world, face);
    wide height = point_dot(n, to_vertex);
    if (height < 0)
        n = point(-n.x, -n.y, -n.z);
    height = fabs(height);
    wide grown = point_magnitudes(from_x) + point_magnitudes(to_vertex) + beam->size + point_magnitudes(x);
    b->apex = x;
    b->u = point_add(point_scale(-point_dot(n, beam->u), from_x), point_scale(height, beam->u));
    b->v = point_add(point_scale(-point_dot(n, beam->v), from_x), point_scale(height, beam->v));
    b->c0 = point_add(point_scale(-point_dot(n, beam->c0), from_x), point_scale(height, beam->c0));
    for (int i = 0; i < 2; i++) {
        b->middle[i] = beam->middle[i];
        b->extent[i] = beam->extent[i];
    }
    b->size = point_magnitudes(x);
    b->width = grown * beam->width;
    wide sides = point_magnitudes(b->u) + point_magnitudes(b->v);
    b->length = grown * beam->length;
    b->mirrored = false;
    b->rounded = beam->rounded + 1;
    EACH_PACKET(k) {
        WideVec c = beam->lanes[k].c;
        b->lanes[k].c = wide_add(wide_scale(-wide_times(n, c), wide_point(from_x)), wide_scale((Wide)height, c));
        b->lanes[k].real_c = vec_to_real(b->lanes[k].c);
        b->lanes[k].length = (real)grown * beam->lanes[k].length;
        b->lanes[k].real_length = TO_REAL(wide_magnitudes(b->lanes[k].c) + sides);
    }
}
