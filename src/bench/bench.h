/* What bench measures, as data: how long scenes take to trace, in this process, beside a peer, and as whole
 * processes. bench_report.h makes tables and JSON of it. */
#ifndef RECTRAY_BENCH_H
#define RECTRAY_BENCH_H

#include "bench/bench_folder.h"
#include "picture/image.h"
#include "opencl/opencl.h"
#include "trace/render.h"
#include "scene/scene.h"

#define BENCH_PEER "build/peers/embree"
#define BENCH_EXPORT "build/peers/povray_export"

enum { BENCH_MAX_REPEATS = 99, BENCH_NAME = 64 };

/* A scene to measure; size 0x0 and grid 0 mean: as the scene says. */
typedef struct BenchScene {
    char name[BENCH_NAME], path[512];
    int columns, rows, grid;
} BenchScene;

/* How to measure. */
typedef struct BenchPlan {
    RenderSettings settings;
    int repeats;        /* pictures to take the median of */
    bool skips;         /* measure, too, what is left out */
    BenchFolder folder; /* for generated scenes, pictures, caches and the data of plots */
} BenchPlan;

/* A kind of work left out of a scene, and what tracing takes with it left out and with it done. */
typedef struct BenchSkip {
    uint64_t count; /* 0: the scene lets none of it be left out, and nothing was measured */
    double left_ms, done_ms;
    bool same; /* the two pictures */
} BenchSkip;

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
    BenchSkip skips[SKIPS];
    long long differing, far_off; /* pixels of the two pictures that differ, and that do by more than 1 of 255 */
} BenchTrace;

typedef struct BenchPhases {
    double parse, build, device, compile, upload, trace, readback, encode, total;
} BenchPhases;

/* A whole `render` process; wall_ms is measured from outside. */
typedef struct BenchProcess {
    BenchScene scene;
    BenchPhases cold, warm;                            /* cold: with an empty kernel cache */
    double cold_wall_ms, warm_wall_ms, povray_wall_ms; /* povray: 0 where it is not there */
    double peak_bytes;
} BenchProcess;

/* Fills in what the scene itself says of its size and grid; of a scene that is sampled adaptively a grid of 1. */
bool bench_settle(BenchScene *scene, Error *error);

/* Traces the scene after a warm-up, turn by turn with the peer where it is built. */
bool bench_trace(BenchTrace *result, const BenchScene *scene, const BenchPlan *plan, Error *error);

/* One picture of ours; `picture`, of the scene's size, is filled where it is not NULL. */
bool bench_trace_once(OpenclScene *held, Image *picture, RenderReport *report, Error *error);

/* Measures what is left out of a scene that was traced into the result. */
bool bench_skips(BenchTrace *result, const Scene *scene, const BenchPlan *plan, Error *error);

/* Renders the scene, which must be settled, by starting this program again and again. To be called before bench_trace:
 * on Linux a process begins with the peak memory of the one that started it. */
bool bench_process(BenchProcess *result, const BenchScene *scene, const BenchPlan *plan, Error *error);

/* The same for POV-Ray and the exported scene; leaves 0 where either program is missing. */
bool bench_povray(BenchProcess *result, const BenchPlan *plan, Error *error);

/* Generates the scene's file, KIND-SIZE.json in the folder. */
bool bench_generate(BenchScene *scene, const char *kind, int size, const BenchFolder *folder, Error *error);

/* Sorts the times and returns the middle one, the mean of the middle two where their number is even. */
double bench_median(double *times, int count);

#endif
