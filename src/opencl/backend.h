/* Both backends behind one door: the kernels, and the reference tracer. Here alone one of them is chosen. */
#ifndef RECTRAY_BACKEND_H
#define RECTRAY_BACKEND_H

#include "scene/scene.h"
#include "trace/accel.h"
#include "trace/render.h"

/* Renders the scene; opencl.h and reference_render.h say what may fail. */
bool backend_render(Backend backend, const Scene *scene, const RenderSettings *settings, BandSink sink,
                    RenderReport *report, Error *error);

/* Pictures of one scene after another, such as the frames of a film, of the same size and sampling. Zeroed, nothing has
 * been rendered yet. */
typedef struct BackendFilm {
    struct OpenclScene *held;
    bool same_faces; /* only camera and lights differ; for the caller to say */
} BackendFilm;

/* backend_render for the next one. The scene and what the settings point to must live until the film is closed. */
bool backend_film_render(BackendFilm *film, Backend backend, const Scene *scene, const RenderSettings *settings,
                         BandSink sink, RenderReport *report, Error *error);

void backend_film_close(BackendFilm *film);

/* A scene at which rays are cast, batch after batch. */
typedef struct BackendCaster {
    Backend backend;
    const Scene *scene;
    const RenderSettings *settings;
    Accel accel; /* the reference's; the device keeps its own */
} BackendCaster;

/* The scene and the settings must outlive the caster. The time that its tree takes goes to the report. Close it also
 * after a failure. */
bool backend_caster_open(BackendCaster *caster, Backend backend, const Scene *scene, const RenderSettings *settings,
                         RenderReport *report, Error *error);

/* Intersects `count` rays, six doubles each (origin, direction) in scene coordinates, with the scene's faces. The
 * report, zeroed by the caller, is the batch's own. */
bool backend_cast(const BackendCaster *caster, const double *rays, long count, CastHit *hits, RenderReport *report,
                  Error *error);

void backend_caster_close(BackendCaster *caster);

#endif
