/* Beams: all rays of a pixel at once. A beam is a pyramid; mirrors and planes map it to other pyramids, for everything
 * that happens to it is linear in the direction. So one pyramid is tested against a face instead of many rays: see
 * docs/bounds.md, section 12. Every answer errs on the safe side by more than rounding. */
#ifndef RECTRAY_BEAM_H
#define RECTRAY_BEAM_H

#include "scene/geometry.h"

/* Relative to the magnitudes that meet in a value, more than all rounding: up to 64 mirrors leave an error of some
 * 2^-43 in the apex and the directions, and a value adds a few 2^-53. */
#define BEAM_SLACK 0x1p-38

/* The rays from the apex A in the directions c + a u + b v, for all a and b in [-1, 1]. */
typedef struct Beam {
    Vec3 apex; /* the eye, its image in mirrors, or a light */
    Vec3 c, u, v;
    double size;   /* bounds |A|1, and |A|1 of the apexes before the mirrors */
    double length; /* bounds |d|1 of a direction and of the terms that it was computed from */
    double width;  /* likewise of u and v together */
    bool mirrored; /* the apex has been rounded */
} Beam;

/* A face's plane as the beam sees it: 1/t = -q.d for a ray A + t d to the plane, linear in d. */
typedef struct BeamPlane {
    Vec3 q;       /* N / (N.(A - v0)) */
    double error; /* of q; HUGE_VAL: the plane passes so near the apex that q says nothing */
    int side;     /* of the plane, on which A is: +1 where N points; 0: in the plane, or too near to tell */
} BeamPlane;

/* The beam of a pixel, from the eye. */
Beam beam_of_pixel(const View *view, int column, int row);

BeamPlane beam_plane(const Beam *beam, const Face *face, const Plane *plane);

typedef enum BeamCover {
    BEAM_CLEAR,   /* no ray of the beam passes inside the face's edges */
    BEAM_CROSSED, /* some may */
    BEAM_FILLED,  /* all do */
} BeamCover;

BeamCover beam_cover(const Beam *beam, const Face *face, const BeamPlane *seen);

/* Whether plane b is farther along the beam than plane a, for each of its rays. */
bool beam_is_farther(const Beam *beam, const BeamPlane *a, const BeamPlane *b);

/* The beam after a mirror: from the apex's image. */
Beam beam_mirrored(const Beam *beam, const Face *face, const Plane *plane);

/* The beam from the point X to where this one meets the face's plane. */
Beam beam_from_point(const Beam *beam, const Face *face, const Plane *plane, Vec3 x);

#endif
