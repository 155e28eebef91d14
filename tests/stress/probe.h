/* A device kept open for the suite: the product's own kernels, and beside them, compiled with the same sources, a few
 * that ask single functions of the product what no command shows: every face hit, one shadow segment, the shifted
 * point. */
#ifndef RECTRAY_STRESS_PROBE_H
#define RECTRAY_STRESS_PROBE_H

#include "opencl/device_scene.h"
#include "opencl/opencl_session.h"

typedef struct Probe {
    OpenclSession session;
    cl_mem parameters, faces, face_rows, planes, materials, lights, view, counters;
    Parameters launch;
    bool loaded;
} Probe;

/* Ends the program with the error's message unless `ok`. */
void stop_unless(bool ok, const Error *error);

/* Puts the product's and the probe's kernels where the product will read them, and takes them away again. Between the
 * two lies what RECTRAY_KERNELS was before. */
char *probe_sources_write(void);
void probe_sources_remove(char *kept);

/* Failures of the machine end the program with a message: there is no test without a device. */
void probe_open(Probe *probe, Precision precision);
void probe_close(Probe *probe);
void probe_load(Probe *probe, const Scene *scene);

/* Rays are origin and direction, segments both ends; points are three doubles each. */
void probe_nearest(Probe *probe, const double *rays, long count, CastHit *hits);
void probe_counts(Probe *probe, const double *rays, long count, int *counts);
void probe_blocked(Probe *probe, const double *segments, const int *left, long count, int *blocked);
void probe_points(Probe *probe, const double *rays, long count, CastHit *hits, double *points, double *shifted);

/* RGB, linear, three doubles per ray. */
void probe_colours(Probe *probe, const double *rays, long count, double *colours);

/* pairs: base and exponent, as power() takes them. A scene must be loaded, any. */
void probe_powers(Probe *probe, const double *pairs, long count, double *powers);

#endif
