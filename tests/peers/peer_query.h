/* The two questions to Embree, for a block of 8 x 8 pixels at once: four packets of sixteen lanes. Which of Embree's
 * ways of asking is fastest depends on the scene and the kind of ray, so each is a mode, and embree.c tries them. */
#ifndef RECTRAY_PEER_QUERY_H
#define RECTRAY_PEER_QUERY_H

#include "peer_scene.h"

enum { WIDTH = 16, PACKETS = 4 };

typedef struct QueryMode {
    const char *name;
    int width; /* rays per call: 1, 8, 16, or the whole block's 64 as a stream */
    bool coherent;
} QueryMode;

extern const QueryMode query_modes[]; /* ends in a NULL name */

/* -1: this lane asks; 0: it does not. */
typedef struct Lanes {
    int on[PACKETS][WIDTH] __attribute__((aligned(64)));
} Lanes;

/* The nearest hit of every lane that asks; the rays of the others are left as they were or lose their tfar. */
void query_nearest(const PeerScene *peer, const QueryMode *mode, const Lanes *lanes, struct RTCRayHit16 *rays);

/* Sets tfar to -infinity where something stands between tnear and tfar. sign: see QueryContext. */
void query_occluded(const PeerScene *peer, const QueryMode *mode, float sign, const Lanes *lanes,
                    struct RTCRay16 *rays);

#endif
