/* Which faces a beam meets on its way: all are tested, or those that a tree finds. */
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
    bool shadow;         /* towards a light: one face that fills the beam is enough, others do not matter */
    int filled_by;       /* the answer: a face that fills the beam, -1: none */
    int crossed_by;      /* the answer: the first face found that may cross it, -1: none */
    uint64_t box_tests, face_tests;
} BeamQuery;

/* Begins a query along the beam. */
BeamQuery beam_query(const Scene *scene, const Beam *beam, int from, int to);

/* Finds the answers, through the tree, or among all faces where there is none. They depend on the faces alone, not on
 * the tree. */
void beam_query_run(BeamQuery *query, const Accel *accel);

#endif
