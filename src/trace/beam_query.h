/* Which faces a beam meets on its way: all are asked, or those of a tree. */
#ifndef RECTRAY_BEAM_QUERY_H
#define RECTRAY_BEAM_QUERY_H

#include "trace/accel.h"
#include "trace/beam.h"

/* A stretch of a beam in which there may be other faces. Face numbers are places in the scene. */
typedef struct BeamQuery {
    const Scene *scene;
    Beam beam;
    int from, to;        /* it runs from the plane of face `from` (-1: the apex) to that of `to` (-1: without end) */
    BeamPlane near, far; /* those planes */
    bool shadow;         /* does one face fill the beam? Then others do not matter */
    int filled_by;       /* the answers: a face that does, -1: none, */
    int crossed_by;      /* and the first one found that may be there, -1: none */
    uint64_t box_tests, face_tests;
} BeamQuery;

/* Begins a query along the beam; then the tree is asked, or all faces where there is none. Which faces answer depends
 * on the faces alone, not on the tree. */
BeamQuery beam_query(const Scene *scene, const Beam *beam, int from, int to);
void beam_ask(BeamQuery *query, const Accel *accel);

#endif
