/* How long a scene takes to trace, in this process and beside a peer. */
#ifndef RECTRAY_BENCH_TRACE_H
#define RECTRAY_BENCH_TRACE_H

#include "bench/bench.h"
#include "bench/bench_skip.h"

#define BENCH_PEER "build/peers/embree"

/* Times are medians, in milliseconds. */
typedef struct BenchTrace {
    BenchScene scene;
    int faces, lights;
    RenderReport report; /* of the last repeat */
    double trace_ms, build_ms;
    double fastest_ms, slowest_ms;
    double primary_ms;          /* the same scene without lights: primary rays alone */
    double unmirrored_ms;       /* without bounces: primary rays and their shadow rays */
    uint64_t unmirrored_shadow; /* shadow rays of that */
    bool has_peer;
    char peer[64], peer_modes[3][64];                /* its name; how it asks for primary, shadow and reflected rays */
    double peer_trace_ms, peer_build_ms, peer_share; /* share: of the time, inside the peer's own code */
    double peer_bytes;
    RayCounts peer_rays;
    BenchSkip skips[SKIP_KINDS];
    long long differing, far_off; /* pixels of the two pictures that differ, and that do by more than 1 of 255 */
} BenchTrace;

/* Fills in what the scene itself says of its size and grid; of a scene that is sampled adaptively a grid of 1. */
bool bench_settle(BenchScene *scene, const BenchPlan *plan, Error *error);

/* Traces the scene after a warm-up, turn by turn with the peer where it is built. */
bool bench_trace(BenchTrace *result, const BenchScene *scene, const BenchPlan *plan, Error *error);

#endif
