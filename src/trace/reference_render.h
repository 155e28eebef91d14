/* Whole pictures with the reference tracer: rows shared out to threads, bands handed on in order. */
#ifndef RECTRAY_REFERENCE_RENDER_H
#define RECTRAY_REFERENCE_RENDER_H

#include "scene/scene.h"
#include "trace/render.h"

/* Renders the scene in exact or in textbook arithmetic; the bytes do not depend on the number of threads. False with an
 * Error when memory or the sink fails, or what is asked for is not in the text. */
bool reference_render(const Scene *scene, const RenderSettings *settings, BandSink sink, RenderReport *report,
                      Error *error);

#endif
