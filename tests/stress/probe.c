/* The OpenCL calls around the probe kernels. */
#include "probe.h"

#include "opencl/opencl_cast.h"
#include "opencl/opencl_program.h"
#include "opencl/opencl_status.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

void stop_unless(bool ok, const Error *error)
{
    if (ok)
        return;
    fprintf(stderr, "stress: %s\n", error->text);
    exit(3);
}

static void check(cl_int status, const char *call)
{
    Error error = {0};
    stop_unless(opencl_ok(&error, status, call), &error);
}

void probe_open(Probe *probe, Precision precision)
{
    *probe = (Probe){0};
    char *kept = probe_sources_write();
    RenderSettings settings = {.precision = precision, .device = -1};
    RenderReport report = {0};
    Error error = {0};
    Variant no_tree = {ACCEL_NONE, 1, 1};
    probe->session = (OpenclSession){.casts = true};
    bool ok = opencl_open(&probe->session, &settings, &report, &error) &&
              opencl_build(&probe->session, no_tree, &report, &error);
    probe_sources_remove(kept);
    stop_unless(ok, &error);
}

/* --- Buffers --- */

static cl_mem new_buffer(Probe *probe, size_t bytes, const void *data)
{
    cl_int status;
    cl_mem_flags flags = CL_MEM_READ_WRITE | (data ? CL_MEM_COPY_HOST_PTR : 0);
    cl_mem buffer = clCreateBuffer(probe->session.context, flags, bytes, (void *)(size_t)data, &status);
    check(status, "clCreateBuffer");
    return buffer;
}

static void unload(Probe *probe)
{
    cl_mem buffers[] = {probe->parameters, probe->faces,  probe->face_rows, probe->planes,
                        probe->materials,  probe->lights, probe->view,      probe->counters};
    for (size_t i = 0; probe->loaded && i < sizeof buffers / sizeof buffers[0]; i++)
        clReleaseMemObject(buffers[i]);
    probe->loaded = false;
}

void probe_close(Probe *probe)
{
    unload(probe);
    opencl_close(&probe->session);
}

void probe_load(Probe *probe, const Scene *scene)
{
    unload(probe);
    DeviceScene packed;
    Error error = {0};
    Precision wide = probe->session.wide_is_double ? PRECISION_DOUBLE : PRECISION_FLOAT;
    DevicePacking how = {.precision = probe->session.precision, .wide = wide, .threads = 1};
    stop_unless(device_scene_pack(&packed, scene, &how, &error), &error);
    size_t faces = (size_t)(scene->face_count > 0 ? scene->face_count : 1);
    probe->parameters = new_buffer(probe, sizeof(Parameters), NULL);
    probe->faces = new_buffer(probe, faces * sizeof(FaceRecord), packed.faces.records);
    probe->face_rows = new_buffer(probe, device_reals_bytes(&packed.faces.rows), packed.faces.rows.data);
    probe->planes = new_buffer(probe, device_reals_bytes(&packed.faces.planes), packed.faces.planes.data);
    probe->materials = new_buffer(probe, device_reals_bytes(&packed.materials), packed.materials.data);
    probe->lights = new_buffer(probe, device_reals_bytes(&packed.lights), packed.lights.data);
    probe->view = new_buffer(probe, device_reals_bytes(&packed.view), packed.view.data);
    probe->counters = new_buffer(probe, COUNTER_STRIPES * COUNTER_STRIDE * sizeof(cl_uint), NULL);
    probe->launch = (Parameters){
        .face_count = scene->face_count,
        .light_count = scene->light_count,
        .no_skip = 1 << SKIP_WEAK_BOUNCE,
        .max_bounces = scene->shading.max_bounces,
        .shadow_ambient = scene->shading.shadow == SHADOW_AMBIENT,
        .viewer_ray = scene->shading.viewer == VIEWER_RAY,
    };
    probe->loaded = true;
    device_scene_free(&packed);
}

/* `count` doubles as the device's wides. */
static cl_mem new_wides(Probe *probe, const double *numbers, size_t count)
{
    void *data = malloc(count * opencl_cast_bytes(&probe->session));
    opencl_cast_put(&probe->session, numbers, count, data);
    cl_mem buffer = new_buffer(probe, count * opencl_cast_bytes(&probe->session), data);
    free(data);
    return buffer;
}

/* Room for so many of them. */
static cl_mem room_for_wides(Probe *probe, size_t count)
{
    return new_buffer(probe, count * opencl_cast_bytes(&probe->session), NULL);
}

static void read_buffer(Probe *probe, cl_mem buffer, size_t bytes, void *data)
{
    check(clEnqueueReadBuffer(probe->session.queue, buffer, CL_TRUE, 0, bytes, data, 0, NULL, NULL),
          "clEnqueueReadBuffer");
}

static void read_wides(Probe *probe, cl_mem buffer, size_t count, double *out)
{
    size_t bytes = count * opencl_cast_bytes(&probe->session);
    void *data = malloc(bytes);
    read_buffer(probe, buffer, bytes, data);
    opencl_cast_get(&probe->session, data, count, out);
    free(data);
}

static size_t real_bytes(const Probe *probe)
{
    return probe->session.precision == PRECISION_DOUBLE ? sizeof(double) : sizeof(float);
}

static void read_reals(Probe *probe, cl_mem buffer, size_t count, double *out)
{
    if (probe->session.precision == PRECISION_DOUBLE) {
        read_buffer(probe, buffer, count * sizeof *out, out);
        return;
    }
    float *floats = malloc(count * sizeof *floats);
    read_buffer(probe, buffer, count * sizeof *floats, floats);
    for (size_t i = 0; i < count; i++)
        out[i] = (double)floats[i];
    free(floats);
}

/* --- Runs --- */

static void run(Probe *probe, const char *name, const cl_mem *arguments, int argument_count, long count, size_t items)
{
    Parameters parameters = probe->launch;
    parameters.ray_count = (int)count;
    Error error = {0};
    check(clEnqueueWriteBuffer(probe->session.queue, probe->parameters, CL_TRUE, 0, sizeof parameters, &parameters, 0,
                               NULL, NULL),
          "clEnqueueWriteBuffer");
    cl_kernel kernel = opencl_kernel(&probe->session.programs[PROGRAM_MAIN], name, arguments, argument_count, &error);
    stop_unless(kernel && opencl_run(&probe->session, kernel, items, &error), &error);
    clReleaseKernel(kernel);
}

/* Of the arguments so many: the last one, the view, is for pairs only. */
static int without_view(const Probe *probe, int count)
{
    return probe->session.casts_pairs ? count : count - 1;
}

static void read_hits(Probe *probe, cl_mem faces, cl_mem t, long count, CastHit *hits)
{
    cl_int *face = malloc((size_t)count * sizeof *face);
    double *parameter = malloc((size_t)count * sizeof *parameter);
    read_buffer(probe, faces, (size_t)count * sizeof *face, face);
    read_wides(probe, t, (size_t)count, parameter);
    for (long i = 0; i < count; i++)
        hits[i] = (CastHit){face[i], parameter[i]};
    free(face);
    free(parameter);
}

void probe_nearest(Probe *probe, const double *rays, long count, CastHit *hits)
{
    size_t lanes = (size_t)probe->session.lanes;
    cl_mem input = new_wides(probe, rays, (size_t)count * 6);
    cl_mem faces = new_buffer(probe, (size_t)count * sizeof(cl_int), NULL);
    cl_mem t = room_for_wides(probe, (size_t)count);
    cl_mem arguments[] = {probe->parameters, probe->faces,     probe->face_rows, probe->planes, input, faces, t,
                          probe->counters,   probe->face_rows, probe->faces,     probe->view}; /* no tree: never read */
    run(probe, "cast", arguments, without_view(probe, 11), count, ((size_t)count + lanes - 1) / lanes);
    read_hits(probe, faces, t, count, hits);
    clReleaseMemObject(input);
    clReleaseMemObject(faces);
    clReleaseMemObject(t);
}

void probe_counts(Probe *probe, const double *rays, long count, int *counts)
{
    cl_mem input = new_wides(probe, rays, (size_t)count * 6);
    cl_mem output = new_buffer(probe, (size_t)count * sizeof(cl_int), NULL);
    cl_mem arguments[] = {probe->parameters, probe->faces, probe->face_rows, probe->planes, input, output, probe->view};
    run(probe, "probe_counts", arguments, without_view(probe, 7), count, (size_t)count);
    read_buffer(probe, output, (size_t)count * sizeof(cl_int), counts);
    clReleaseMemObject(input);
    clReleaseMemObject(output);
}

void probe_blocked(Probe *probe, const double *segments, const int *left, long count, int *blocked)
{
    cl_mem input = new_wides(probe, segments, (size_t)count * 6);
    cl_mem leaving = new_buffer(probe, (size_t)count * sizeof(cl_int), left);
    cl_mem output = new_buffer(probe, (size_t)count * sizeof(cl_int), NULL);
    cl_mem arguments[] = {probe->parameters, probe->faces, probe->face_rows, probe->planes, input,
                          leaving,           output,       probe->view};
    run(probe, "probe_blocked", arguments, without_view(probe, 8), count, (size_t)count);
    read_buffer(probe, output, (size_t)count * sizeof(cl_int), blocked);
    clReleaseMemObject(input);
    clReleaseMemObject(leaving);
    clReleaseMemObject(output);
}

void probe_points(Probe *probe, const double *rays, long count, CastHit *hits, double *points, double *shifted)
{
    cl_mem input = new_wides(probe, rays, (size_t)count * 6);
    cl_mem faces = new_buffer(probe, (size_t)count * sizeof(cl_int), NULL);
    cl_mem t = room_for_wides(probe, (size_t)count);
    cl_mem output = room_for_wides(probe, (size_t)count * 6);
    cl_mem arguments[] = {probe->parameters,
                          probe->faces,
                          probe->face_rows,
                          probe->planes,
                          probe->materials,
                          probe->lights,
                          probe->view,
                          input,
                          faces,
                          t,
                          output};
    run(probe, "probe_points", arguments, 11, count, (size_t)count);
    read_hits(probe, faces, t, count, hits);
    double *both = malloc((size_t)count * 6 * sizeof *both);
    read_wides(probe, output, (size_t)count * 6, both);
    for (long i = 0; i < count; i++) {
        memcpy(points + 3 * i, both + 6 * i, 3 * sizeof *points);
        memcpy(shifted + 3 * i, both + 6 * i + 3, 3 * sizeof *shifted);
    }
    free(both);
    clReleaseMemObject(input);
    clReleaseMemObject(faces);
    clReleaseMemObject(t);
    clReleaseMemObject(output);
}

void probe_colours(Probe *probe, const double *rays, long count, double *colours)
{
    cl_mem input = new_wides(probe, rays, (size_t)count * 6);
    cl_mem output = new_buffer(probe, (size_t)count * 3 * real_bytes(probe), NULL);
    cl_mem arguments[] = {probe->parameters,
                          probe->faces,
                          probe->face_rows,
                          probe->planes,
                          probe->materials,
                          probe->lights,
                          probe->view,
                          input,
                          output};
    run(probe, "probe_colours", arguments, 9, count, (size_t)count);
    read_reals(probe, output, (size_t)count * 3, colours);
    clReleaseMemObject(input);
    clReleaseMemObject(output);
}

void probe_powers(Probe *probe, const double *pairs, long count, double *powers)
{
    cl_mem input = new_wides(probe, pairs, (size_t)count * 2);
    cl_mem output = new_buffer(probe, (size_t)count * real_bytes(probe), NULL);
    cl_mem arguments[] = {probe->parameters, input, output};
    run(probe, "probe_powers", arguments, 3, count, (size_t)count);
    read_reals(probe, output, (size_t)count, powers);
    clReleaseMemObject(input);
    clReleaseMemObject(output);
}
