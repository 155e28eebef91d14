/* The choice between the kernels and the reference tracer. */
#include "opencl/backend.h"

#include "base/clock.h"
#include "opencl/opencl.h"
#include "opencl/opencl_cast.h"
#include "trace/reference_cast.h"
#include "trace/reference_render.h"

bool backend_render(Backend backend, const Scene *scene, const RenderSettings *settings, BandSink sink,
                    RenderReport *report, Error *error)
{
    return backend == BACKEND_REFERENCE ? reference_render(scene, settings, sink, report, error)
                                        : opencl_render(scene, settings, sink, report, error);
}

bool backend_film_render(BackendFilm *film, Backend backend, const Scene *scene, const RenderSettings *settings,
                         BandSink sink, RenderReport *report, Error *error)
{
    if (backend == BACKEND_REFERENCE)
        return reference_render(scene, settings, sink, report, error);
    if (!film->held)
        film->held = opencl_hold(scene, settings, error);
    else if (!opencl_exchange(film->held, scene, film->same_faces, settings, error))
        return false;
    return film->held && opencl_picture(film->held, sink, report, error);
}

void backend_film_close(BackendFilm *film)
{
    opencl_release(film->held);
    film->held = NULL;
}

bool backend_caster_open(BackendCaster *caster, Backend backend, const Scene *scene, const RenderSettings *settings,
                         RenderReport *report, Error *error)
{
    *caster = (BackendCaster){.backend = backend, .scene = scene, .settings = settings};
    if (backend != BACKEND_REFERENCE)
        return true;
    double start = clock_ms();
    bool built = accel_build(&caster->accel, scene, settings->accel, settings->threads, error);
    report->build_ms = clock_ms() - start;
    return built;
}

bool backend_cast(const BackendCaster *caster, const double *rays, long count, CastHit *hits, RenderReport *report,
                  Error *error)
{
    if (caster->backend != BACKEND_REFERENCE)
        return opencl_cast(caster->scene, caster->settings, rays, count, hits, report, error);
    reference_cast(caster->scene, &caster->accel, rays, count, hits, report);
    return true;
}

void backend_caster_close(BackendCaster *caster)
{
    accel_free(&caster->accel);
}
