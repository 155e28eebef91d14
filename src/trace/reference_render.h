/* Pictures with the reference tracer: rows shared out to threads, bands handed on in order. */
#ifndef RECTRAY_REFERENCE_RENDER_H
#define RECTRAY_REFERENCE_RENDER_H

#include "scene/scene.h"
#include "trace/accel.h"

/* Renders the scene in exact or in textbook arithmetic; the bytes do not depend on the number of threads. False with an
 * Error when memory or the sink fails, or what is asked for is not in the text. */
bool reference_render(const Scene *scene, const RenderSettings *settings, BandSink sink, RenderReport *report,
                      Error *error);

/* A step through the numbers of `count` pixels that reaches all of them, and spreads any few of them evenly. */
int reference_spread(int count);

/* Renders single pixels that are spread over the region, `most` of them or as many as fit into `most_ms` milliseconds,
 * on one thread. Returns how many, at least 1. The report receives their counts and their time. */
int reference_try(const Scene *scene, const Accel *accel, const RenderSettings *settings, int most, double most_ms,
                  RenderReport *report);

#endif
