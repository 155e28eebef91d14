/* What the stress tests have in common: the ways to trace that they compare, rays by the million, a table of failures.
 * Four methods answer the same rays: the taught formulas in float32 (a baseline, which is allowed to fail), the kernels
 * in float and in double, the reference. The exact oracle judges.
 * To add a test, write a function in a file of its subject and name it in main.c. */
#ifndef RECTRAY_STRESS_SUITE_H
#define RECTRAY_STRESS_SUITE_H

#include "probe.h"
#include "random.h"
#include "scene/scene.h"
#include "trace/accel.h"
#include "trace/render.h"

typedef enum Method { TEXTBOOK, KERNEL_FLOAT, KERNEL_DOUBLE, REFERENCE, METHOD_COUNT } Method;

enum { MAX_ROWS = 400, BATCH = 1 << 17 };

/* A line of the table: of each method, how many rays and how many of them wrong, or a measured value and its limit. */
typedef struct Row {
    int test;
    char label[80];
    bool measured;
    double limit[METHOD_COUNT], value[METHOD_COUNT]; /* measured */
    long rays[METHOD_COUNT], failures[METHOD_COUNT], ties[METHOD_COUNT];
} Row;

typedef struct Suite {
    uint64_t seed;
    double scale; /* of the counts of rays */
    Random random;
    Probe probes[2];    /* float, double */
    const Scene *scene; /* the one loaded */
    Accel accel;
    Row *rows;
    int row_count, test, shown; /* shown: failures printed in this row */
    const char *test_name;
} Suite;

bool method_is_float(Method method);
const char *method_name(Method method);

/* Is the method there? A device without double has no kernel in double. */
bool method_is_here(const Suite *suite, Method method);

/* count, scaled, at least one. */
long suite_count(const Suite *suite, double count);

/* Makes the scene the one that all methods trace. */
void suite_load(Suite *suite, const Scene *scene);

/* Begins a line of the table. */
void suite_row(Suite *suite, const char *format, ...) __attribute__((format(printf, 2, 3)));

/* Adds to the line's counts. */
void suite_rays(Suite *suite, Method method, long rays);

/* Counts a failure and prints the first few with the command that reproduces them. ray: NULL where there is none. */
void suite_fail(Suite *suite, Method method, const double *ray, const char *format, ...)
    __attribute__((format(printf, 4, 5)));

/* One measured value and the most it may be; limit < 0: any. */
void suite_measure(Suite *suite, Method method, long rays, double value, double limit);

/* Rays by the batch. Half of the batches hold floats and go to all methods; half hold doubles: not to the textbook.
 * Where the device has no double, they hold what pairs of floats can. */
typedef struct Cast {
    double count;
    void *user;
    void (*aim)(void *user, Random *random, double ray[6]);
    int (*truth)(const Scene *scene, const double ray[6]); /* NULL, or what the oracle says: asked once per ray */
    /* NULL, or what is wrong; TIE where two faces are within rounding of each other. */
    const char *(*check)(void *user, const Scene *scene, Method method, const double ray[6], int truth, CastHit hit);
    bool counts; /* not the nearest face: hit.face is how many faces the ray hits */
} Cast;

extern const char TIE[];

void suite_cast(Suite *suite, const Cast *cast);

/* What each method says; the textbook wants rays of floats, as method_round makes them. */
void method_round(Method method, double *numbers, long count);
void method_round_to_device(const Suite *suite, double *numbers, long count);
void method_nearest(Suite *suite, Method method, const double *rays, long count, CastHit *hits);
void method_counts(Suite *suite, Method method, const double *rays, long count, CastHit *hits);
void method_blocked(Suite *suite, Method method, const double *segments, const int *left, long count, int *blocked);
void method_points(Suite *suite, Method method, const double *rays, long count, CastHit *hits, double *points,
                   double *shifted);

/* The oracle on a scene: the nearest face (of equal t the first; -1: none), and how many are hit. */
int true_nearest(const Scene *scene, const double ray[6]);
int true_count(const Scene *scene, const double ray[6]);
bool true_blocked(const Scene *scene, const double segment[6], int left);

/* A check for `Cast` with true_nearest: the right face, or one within 2 ulp of it. */
const char *check_nearest(void *user, const Scene *scene, Method method, const double ray[6], int truth, CastHit hit);

/* One ulp of x in the method's precision. */
double method_ulp(Method method, double x);

#endif
