/* Whole pictures with Embree, by the same rules as ours (docs/algorithm.md). Floats throughout, in sixteen lanes. */
#ifndef RECTRAY_PEER_TRACE_H
#define RECTRAY_PEER_TRACE_H

#include "peer_query.h"
#include "trace/render.h"

/* How each kind of ray is asked, and which way shadow rays run. */
typedef struct PeerModes {
    const QueryMode *primary, *shadow, *reflection;
    bool from_light;
} PeerModes;

typedef struct PeerReport {
    RayCounts rays;
    double trace_ms;
    double query_ms; /* of all threads, inside Embree; only where it was asked for */
} PeerReport;

/* rgb: rows * columns * 3 bytes. `timed` looks at the clock around every query, which costs a little. */
PeerReport peer_trace(const PeerScene *peer, PeerModes modes, int threads, bool timed, unsigned char *rgb);

#endif
