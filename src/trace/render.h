/* What both backends take and give: settings, counters, and bands of finished pixels.
 * A backend renders rows from the top and hands them on as they are done, so that a picture larger than
 * the memory can be written. It renders the whole picture, or a region of it. */
#ifndef RECTRAY_RENDER_H
#define RECTRAY_RENDER_H

#include "base/error.h"
#include "scene/scene.h"

#include "kernels/shared/skips.h"

#include <stdint.h>

typedef enum Backend { BACKEND_OPENCL, BACKEND_REFERENCE } Backend;
typedef enum Precision { PRECISION_FLOAT, PRECISION_DOUBLE } Precision;

/* How a tracer finds faces. ACCEL_LBVH asks for a bounding volume hierarchy made by sorting: bvh_morton.h. */
typedef enum AccelKind { ACCEL_AUTO, ACCEL_NONE, ACCEL_KDTREE, ACCEL_BVH, ACCEL_LBVH } AccelKind;

/* The OpenCL kernel: the one that suits the device; packets of rays, fast on processors; the plain one, a ray per
 * work-item, written to be read; or the one for GPUs. */
typedef enum KernelKind { KERNEL_AUTO, KERNEL_PACKET, KERNEL_PLAIN, KERNEL_GPU } KernelKind;

/* How a ray is tested against a face: so that rounding decides nothing, or by the taught formulas as they stand. The
 * second is that of the plain kernel and of textbook.h. */
typedef enum Arithmetic { ARITHMETIC_EXACT, ARITHMETIC_TEXTBOOK } Arithmetic;

/* What users call them: options, statistics and measurements. Each list ends in a NULL. */
extern const char *const render_backends[], *const render_precisions[], *const render_accels[];
extern const char *const render_kernels[], *const render_arithmetics[];

/* What a map of a picture shows of each pixel: map.h. */
typedef enum MapKind {
    MAP_RAYS,   /* rays traced for it, of all kinds */
    MAP_TIME,   /* milliseconds */
    MAP_DEPTH,  /* how far the ray through its centre goes */
    MAP_NORMAL, /* of the face that this ray hits, on its side */
    MAP_FACE,   /* that face */
    MAP_TESTS,  /* faces and nodes of a tree that its rays were tested against, of all kinds */
} MapKind;

/* Shows the user what takes long before there is a picture, such as "compiling ...": a few words, without a newline.
 * And how long the picture itself will take, where a backend foresees that it is long. */
typedef struct Notice {
    void (*show)(void *user, const char *text); /* NULL: nobody looks, as of the next */
    void (*foresee)(void *user, double seconds);
    void *user;
} Notice;

/* Called once nothing will ask for the planes of the scene's faces again, which are a fifth of a large scene's memory.
 * Who gives it is free to free them then. */
typedef struct Spent {
    void (*planes)(void *user); /* NULL: they are to stay */
    void *user;
} Spent;

/* A rectangle of the picture's pixels. */
typedef struct Region {
    int column, row;   /* of its top left pixel */
    int columns, rows; /* 0: it is the whole picture */
} Region;

typedef struct RenderSettings {
    Precision precision; /* of the kernel and of textbook arithmetic; the reference is double otherwise */
    KernelKind kernel;
    Arithmetic arithmetic;
    float shift; /* textbook arithmetic: how far off its face a point is shifted */
    AccelKind accel;
    int threads;      /* 0: one per processor */
    int device;       /* number in the list of `rectray devices`; -1: the default */
    int lanes;        /* rays per work-item: 1, 4, 8 or 16; 0: what suits the device */
    unsigned no_skip; /* bit SKIP_...: that work is done although the scene does not need it */
    Notice notice;
    Spent spent;
    Region region;  /* of the picture, within it: nothing else is rendered, and its pixels are those of the picture */
    double *linear; /* of the region: rows * columns * 3 colours, filled before they are clamped; NULL: not wanted */
} RenderSettings;

typedef struct RayCounts {
    uint64_t primary, shadow, reflection;
} RayCounts;

/* What a backend measured; zero where it has nothing to tell. Times are milliseconds of wall clock. */
typedef struct RenderReport {
    double build_ms; /* acceleration structures */
    double upload_ms;
    double device_ms;  /* finding and opening the device */
    double compile_ms; /* building the kernel */
    double trace_ms;
    double readback_ms;
    RayCounts rays;
    uint64_t box_tests, face_tests;
    uint64_t refined_pixels;      /* by adaptive sampling: those that got more than their centre */
    uint64_t exact_pixels;        /* by the kernel for GPUs: those that float left to the exact pass */
    uint64_t skipped[SKIP_KINDS]; /* what was left out, by kind: skips.h says in what it is counted */
    uint64_t device_bytes;        /* of the scene and its tree in the device's memory */
    int lanes, threads;
    AccelKind accel;   /* the one used */
    KernelKind kernel; /* the one used; KERNEL_AUTO: none of OpenCL's */
    char device[128];
    char build_options[320];
} RenderReport;

/* Receives finished rows of the region, counted from its top: rgb holds rows * columns * 3 bytes. Bands come from the
 * top, without gaps. `so_far` tells what the backend has done up to this band. Returns false, with the error filled, to
 * stop the rendering. */
typedef struct BandSink {
    bool (*band)(void *user, int first_row, int rows, const unsigned char *rgb, const RenderReport *so_far,
                 Error *error);
    void *user;
} BandSink;

/* The region of the settings, which is all of the picture where they name none. */
Region render_region(const RenderSettings *settings, const Scene *scene);

/* One intersection, for `cast`: face is an index into Scene.faces, -1 for a miss. */
typedef struct CastHit {
    int face;
    double t;
} CastHit;

#endif
