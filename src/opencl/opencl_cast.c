/* The OpenCL backend: casts rays at a scene. */
#include "opencl/opencl_cast.h"

#include "opencl/opencl_program.h"
#include "opencl/opencl_upload.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

size_t opencl_cast_bytes(const OpenclSession *session)
{
    return session->wide_is_double ? sizeof(double) : session->casts_pairs ? 2 * sizeof(float) : sizeof(float);
}

void opencl_cast_put(const OpenclSession *session, const double *numbers, size_t count, void *data)
{
    float *floats = data;
    if (session->wide_is_double) {
        memcpy(data, numbers, count * sizeof *numbers);
        return;
    }
    for (size_t i = 0; i < count; i++) {
        float high = (float)numbers[i];
        *floats++ = high;
        if (session->casts_pairs)
            *floats++ = isfinite(high) ? (float)(numbers[i] - (double)high) : 0;
    }
}

void opencl_cast_get(const OpenclSession *session, const void *data, size_t count, double *numbers)
{
    const float *floats = data;
    if (session->wide_is_double) {
        memcpy(numbers, data, count * sizeof *numbers);
        return;
    }
    for (size_t i = 0; i < count; i++)
        numbers[i] = session->casts_pairs ? (double)floats[2 * i] + (double)floats[2 * i + 1] : (double)floats[i];
}

/* Rays and hits in the device's types; the caller frees all three. */
typedef struct CastArrays {
    void *rays, *t;
    cl_int *faces;
    size_t bytes; /* of a number */
} CastArrays;

static bool cast_arrays(CastArrays *arrays, const OpenclSession *session, const double *rays, long count, Error *error)
{
    size_t values = (size_t)count * 6;
    arrays->bytes = opencl_cast_bytes(session);
    arrays->rays = malloc(values * arrays->bytes);
    arrays->faces = malloc((size_t)count * sizeof(cl_int));
    arrays->t = malloc((size_t)count * arrays->bytes);
    if (!arrays->rays || !arrays->faces || !arrays->t)
        return error_memory(error, "the rays");
    opencl_cast_put(session, rays, values, arrays->rays);
    return true;
}

static bool cast_session(OpenclSession *session, const Scene *scene, const SceneOnDevice *on_device, CastArrays *arrays,
                         long count, RenderReport *report, Error *error)
{
    size_t rays = (size_t)count;
    cl_mem ray_buffer, face_buffer, t_buffer;
    if (!(ray_buffer = opencl_buffer(session, CL_MEM_READ_ONLY, rays * 6 * arrays->bytes, arrays->rays, error)) ||
        !(face_buffer = opencl_buffer(session, CL_MEM_WRITE_ONLY, rays * sizeof(cl_int), NULL, error)) ||
        !(t_buffer = opencl_buffer(session, CL_MEM_WRITE_ONLY, rays * arrays->bytes, NULL, error)))
        return false;
    /* The last one is for rays of pairs only. */
    cl_mem arguments[] = {
        on_device->parameters, on_device->faces, on_device->face_rows, on_device->planes,      ray_buffer,
        face_buffer,           t_buffer,         on_device->counters,  on_device->tree_floats, on_device->tree_ints,
        on_device->view};
    int argument_count = (int)(sizeof arguments / sizeof arguments[0]) - (session->casts_pairs ? 0 : 1);
    cl_kernel kernel = opencl_kernel(&session->programs[PROGRAM_MAIN], "cast", arguments, argument_count, error);
    if (!kernel)
        return false;
    Parameters parameters = opencl_parameters(scene);
    parameters.ray_count = (int)count;
    size_t items = (rays + (size_t)session->lanes - 1) / (size_t)session->lanes;
    bool ok = opencl_launch(session, on_device, kernel, &parameters, items, report, error) &&
              opencl_read(session, face_buffer, rays * sizeof(cl_int), arrays->faces, report, error) &&
              opencl_read(session, t_buffer, rays * arrays->bytes, arrays->t, report, error);
    if (ok)
        opencl_keep(session);
    clReleaseKernel(kernel);
    return ok;
}

bool opencl_cast(const Scene *scene, const RenderSettings *settings, const double *rays, long count, CastHit *hits,
                 RenderReport *report, Error *error)
{
    memset(report, 0, sizeof *report);
    if (count == 0)
        return true;
    OpenclSession session = {.casts = true};
    CastArrays arrays = {0};
    SceneOnDevice on_device;
    bool ok = opencl_prepare(&session, scene, settings, &on_device, report, error) &&
              cast_arrays(&arrays, &session, rays, count, error) &&
              cast_session(&session, scene, &on_device, &arrays, count, report, error);
    for (long i = 0; ok && i < count; i++) {
        hits[i].face = arrays.faces[i];
        opencl_cast_get(&session, (const char *)arrays.t + (size_t)i * arrays.bytes, 1, &hits[i].t);
    }
    free(arrays.rays);
    free(arrays.faces);
    free(arrays.t);
    opencl_close(&session);
    return ok;
}
