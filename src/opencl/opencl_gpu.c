/* Rendering by kernels/gpu.cl. The queue works in order: of a band it writes zeros to the counters, traces in float,
 * traces exactly what is in doubt, and reads pixels and counters. */
#include "opencl/opencl_gpu.h"

#include "base/clock.h"
#include "opencl/opencl_status.h"

#include <string.h>

enum {
    GROUP_ACROSS = 8, /* as in kernels/gpu/pixels.cl */
    GROUP_ITEMS = GROUP_ACROSS * GROUP_ACROSS,
    MOST_ITEMS = 1 << 20,     /* of a band: enough to fill a GPU, and its list of doubts takes 24 MiB */
    FIRST_SAMPLES = 1 << 17,  /* of the first band: it takes under 100 ms on a small GPU */
    GROWTH = 8,               /* a band is at most so many times as high as the one before */
    EXACT_GROUPS_PER_UNIT = 8 /* groups of the exact pass */
};

#define BAND_MS 50.0 /* a band should take so long: some drivers end launches of a second */

static size_t round_up(size_t count, size_t step)
{
    return (count + step - 1) / step * step;
}

/* --- Making it --- */

static bool make_kernels(GpuPath *path, Error *error)
{
    const SceneOnDevice *scene = path->on_device;
    cl_mem trace[] = {scene->parameters, scene->faces,      scene->face_rows,   scene->materials,
                      scene->lights,     scene->view,       scene->tree_floats, scene->tree_ints,
                      scene->counters,   path->doubt_count, path->doubts,       path->bands[0].pixels.device};
    cl_mem exact[] = {scene->parameters,
                      scene->faces,
                      scene->face_rows,
                      scene->planes,
                      scene->materials,
                      scene->lights,
                      scene->view,
                      scene->tree_floats,
                      scene->tree_ints,
                      scene->counters,
                      path->doubt_count,
                      path->doubts,
                      path->bands[0].pixels.device};
    path->trace = opencl_kernel(&path->session->programs[PROGRAM_MAIN], "render_float", trace,
                                sizeof trace / sizeof trace[0], error);
    path->exact = path->trace ? opencl_kernel(&path->session->programs[PROGRAM_EXACT], "render_doubts", exact,
                                              sizeof exact / sizeof exact[0], error)
                              : NULL;
    return path->exact != NULL;
}

/* Arguments after the buffers: where the pixels go, and which rows they are. */
enum { TRACE_PICTURE = 11, EXACT_PICTURE = 12 };

static bool set_band(const GpuPath *path, const GpuBand *band, Error *error)
{
    cl_int first_row = band->of.first_row, rows = band->of.band_rows, status;
    status = clSetKernelArg(path->trace, TRACE_PICTURE, sizeof(cl_mem), &band->pixels.device);
    if (status == CL_SUCCESS)
        status = clSetKernelArg(path->trace, TRACE_PICTURE + 1, sizeof first_row, &first_row);
    if (status == CL_SUCCESS)
        status = clSetKernelArg(path->trace, TRACE_PICTURE + 2, sizeof rows, &rows);
    if (status == CL_SUCCESS)
        status = clSetKernelArg(path->exact, EXACT_PICTURE, sizeof(cl_mem), &band->pixels.device);
    if (status == CL_SUCCESS)
        status = clSetKernelArg(path->exact, EXACT_PICTURE + 1, sizeof first_row, &first_row);
    return opencl_ok(error, status, "clSetKernelArg");
}

static bool write_without_waiting(const GpuPath *path, cl_mem buffer, const void *data, size_t bytes, Error *error)
{
    return opencl_ok(error, clEnqueueWriteBuffer(path->session->queue, buffer, CL_FALSE, 0, bytes, data, 0, NULL, NULL),
                     "clEnqueueWriteBuffer");
}

static bool launch(const GpuPath *path, cl_kernel kernel, size_t items, size_t group, cl_event *done, Error *error)
{
    return opencl_ok(error,
                     clEnqueueNDRangeKernel(path->session->queue, kernel, 1, NULL, &items, &group, 0, NULL, done),
                     "clEnqueueNDRangeKernel");
}

/* Puts the kernels of a band into the queue. Without rows nothing is done but compiling them. */
static bool launch_band(GpuPath *path, GpuBand *band, Error *error)
{
    static const cl_uint zeros[GPU_COUNTERS];
    const OpenclSession *session = path->session;
    bool is_cpu = strcmp(session->info.type, "CPU") == 0;
    size_t across = round_up((size_t)band->of.band_columns, GROUP_ACROSS), down = (size_t)band->of.band_rows;
    size_t items = across * round_up(down > 0 ? down : 1, GROUP_ACROSS);
    size_t exact_group = is_cpu ? 1 : GROUP_ITEMS;
    size_t exact_items = (size_t)session->info.compute_units * EXACT_GROUPS_PER_UNIT * GROUP_ITEMS;
    return set_band(path, band, error) &&
           write_without_waiting(path, path->doubt_count, zeros, sizeof(cl_uint), error) &&
           write_without_waiting(path, path->on_device->counters, zeros, sizeof zeros, error) &&
           launch(path, path->trace, items, GROUP_ITEMS, &band->traced, error) &&
           launch(path, path->exact, exact_items, exact_group, &band->exact, error);
}

static void forget_events(GpuBand *band)
{
    cl_event *events[] = {&band->traced, &band->exact, &band->read};
    for (size_t i = 0; i < sizeof events / sizeof *events; i++) {
        if (*events[i])
            clReleaseEvent(*events[i]);
        *events[i] = NULL;
    }
}

/* The program is kept when each kernel has run: some devices compile a kernel only then. */
static bool warm_up(GpuPath *path, RenderReport *report, Error *error)
{
    double start = clock_ms();
    GpuBand *band = &path->bands[0];
    band->of = path->parameters;
    band->of.band_rows = 0;
    bool ok =
        write_without_waiting(path, path->on_device->parameters, &path->parameters, sizeof path->parameters, error) &&
        launch_band(path, band, error) && opencl_ok(error, clFinish(path->session->queue), "clFinish");
    forget_events(band);
    if (ok)
        opencl_keep(path->session);
    report->compile_ms += clock_ms() - start;
    return ok;
}

static void take_parameters(GpuPath *path, Parameters parameters)
{
    path->parameters = parameters;
    path->parameters.first_column = path->region.column;
    path->parameters.band_columns = path->region.columns;
}

bool gpu_path_make(GpuPath *path, OpenclSession *session, const SceneOnDevice *on_device, Parameters parameters,
                   double *linear, const Region *region, RenderReport *report, Error *error)
{
    *path = (GpuPath){.session = session, .on_device = on_device, .region = *region};
    take_parameters(path, parameters);
    size_t columns = (size_t)region->columns, rows = MOST_ITEMS / columns / GROUP_ACROSS * GROUP_ACROSS;
    rows = rows > GROUP_ACROSS ? rows : GROUP_ACROSS;
    path->most_rows = rows < (size_t)region->rows ? (int)rows : region->rows;
    size_t pixels = columns * (size_t)path->most_rows;
    /* All pixels of a band may be in doubt. */
    size_t list = pixels * DOUBT_WORDS * sizeof(cl_uint);
    for (int i = 0; i < GPU_BANDS; i++)
        if (!opencl_pixels_make(&path->bands[i].pixels, session, pixels, linear, error))
            return false;
    return (path->doubt_count = opencl_buffer(session, CL_MEM_READ_WRITE, sizeof(cl_uint), NULL, error)) &&
           (path->doubts = opencl_buffer(session, CL_MEM_READ_WRITE, list, NULL, error)) && make_kernels(path, error) &&
           warm_up(path, report, error);
}

void gpu_path_free(GpuPath *path)
{
    for (int i = 0; i < GPU_BANDS; i++) {
        forget_events(&path->bands[i]);
        opencl_pixels_free(&path->bands[i].pixels);
    }
    if (path->trace)
        clReleaseKernel(path->trace);
    if (path->exact)
        clReleaseKernel(path->exact);
    *path = (GpuPath){0};
}

/* --- A picture --- */

static bool read_without_waiting(const GpuPath *path, cl_mem buffer, size_t bytes, void *data, cl_event *done,
                                 Error *error)
{
    return opencl_ok(error, clEnqueueReadBuffer(path->session->queue, buffer, CL_FALSE, 0, bytes, data, 0, NULL, done),
                     "clEnqueueReadBuffer");
}

static bool begin_band(GpuPath *path, GpuBand *band, Error *error)
{
    size_t bytes = opencl_pixels_bytes(path->session, &band->of);
    return launch_band(path, band, error) &&
           read_without_waiting(path, path->on_device->counters, sizeof band->counters, band->counters, NULL, error) &&
           read_without_waiting(path, path->doubt_count, sizeof band->doubts, &band->doubts, NULL, error) &&
           read_without_waiting(path, band->pixels.device, bytes, band->pixels.read, &band->read, error) &&
           opencl_ok(error, clFlush(path->session->queue), "clFlush");
}

/* Milliseconds from the beginning of one command to the end of another. */
static double ms_between(cl_event from, cl_event to)
{
    cl_ulong begun = 0, ended = 0;
    if (clGetEventProfilingInfo(from, CL_PROFILING_COMMAND_START, sizeof begun, &begun, NULL) != CL_SUCCESS ||
        clGetEventProfilingInfo(to, CL_PROFILING_COMMAND_END, sizeof ended, &ended, NULL) != CL_SUCCESS)
        return 0;
    return (double)(ended - begun) / 1e6;
}

/* Waits for a band and hands it on. *ms: how long it was traced. */
static bool end_band(GpuPath *path, GpuBand *band, BandSink sink, RenderReport *report, Error *error)
{
    if (!opencl_ok(error, clWaitForEvents(1, &band->read), "clWaitForEvents"))
        return false;
    report->trace_ms += ms_between(band->traced, band->exact);
    report->readback_ms += ms_between(band->read, band->read);
    forget_events(band);
    opencl_add_counters(band->counters, report);
    report->exact_pixels += band->doubts;
    const Region part = opencl_pixels_part(&band->of, &path->region);
    opencl_pixels_take(&band->pixels, path->session, &part);
    return sink.band(sink.user, part.row, part.rows, band->pixels.rgb, report, error);
}

/* The next band's height, from the last one's time: whole groups. */
static int next_rows(const GpuPath *path, int rows, double ms)
{
    double factor = ms > 0 ? BAND_MS / ms : GROWTH;
    factor = factor > GROWTH ? GROWTH : factor;
    int next = (int)(rows * factor) / GROUP_ACROSS * GROUP_ACROSS;
    next = next > GROUP_ACROSS ? next : GROUP_ACROSS;
    return next < path->most_rows ? next : path->most_rows;
}

static int first_rows(const GpuPath *path)
{
    long row = (long)path->region.columns * path->parameters.grid * path->parameters.grid;
    long rows = FIRST_SAMPLES / row / GROUP_ACROSS * GROUP_ACROSS;
    rows = rows > GROUP_ACROSS ? rows : GROUP_ACROSS;
    return rows < path->most_rows ? (int)rows : path->most_rows;
}

/* The first band is waited for, so that its time tells how high the second may be. Then two are on their way. */
static bool render_bands(GpuPath *path, BandSink sink, RenderReport *report, Error *error)
{
    int rows = first_rows(path), row = path->region.row, end = path->region.row + path->region.rows;
    GpuBand *before = NULL;
    for (int i = 0; row < end || before; i++) {
        GpuBand *band = NULL;
        if (row < end) {
            band = &path->bands[i % GPU_BANDS];
            band->of = path->parameters;
            band->of.first_row = row;
            band->of.band_rows = rows < end - row ? rows : end - row;
            row += band->of.band_rows;
            if (!begin_band(path, band, error))
                return false;
        }
        GpuBand *due = i == 0 ? band : before;
        double ms = report->trace_ms;
        if (due && !end_band(path, due, sink, report, error))
            return false;
        if (due)
            rows = next_rows(path, due->of.band_rows, report->trace_ms - ms);
        before = i == 0 ? NULL : band;
    }
    return true;
}

void gpu_path_fill(GpuPath *path, double *linear)
{
    for (int i = 0; i < GPU_BANDS; i++)
        path->bands[i].pixels.linear = linear;
}

bool gpu_path_picture(GpuPath *path, Parameters parameters, BandSink sink, RenderReport *report, Error *error)
{
    take_parameters(path, parameters);
    bool ok =
        write_without_waiting(path, path->on_device->parameters, &path->parameters, sizeof path->parameters, error) &&
        render_bands(path, sink, report, error);
    if (!ok)
        clFinish(path->session->queue); /* nothing may be written to what is freed next */
    for (int i = 0; i < GPU_BANDS; i++)
        forget_events(&path->bands[i]);
    return ok;
}
