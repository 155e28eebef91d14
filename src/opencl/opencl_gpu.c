/* Rendering by kernels/gpu.cl, or adaptively by gpu_adaptive.cl. The queue works in order: of a band it writes zeros to
 * the counters, launches the passes, and reads pixels and counters. */
#include "opencl/opencl_gpu.h"

#include "base/clock.h"
#include "opencl/opencl_program.h"
#include "opencl/opencl_status.h"
#include "trace/adaptive.h"

enum {
    FIRST_SAMPLES = 1 << 17, /* of the first band: it takes under 100 ms on a small GPU */
    GROWTH = 8               /* a band is at most so many times as high as the one before */
};

#define BAND_MS 50.0 /* a band should take so long: some drivers end launches of a second */

static bool write_without_waiting(const GpuPath *path, cl_mem buffer, const void *data, size_t bytes, Error *error)
{
    return opencl_ok(error, clEnqueueWriteBuffer(path->session->queue, buffer, CL_FALSE, 0, bytes, data, 0, NULL, NULL),
                     "clEnqueueWriteBuffer");
}

/* Puts the kernels of a band into the queue. Without rows nothing is done but compiling them. */
static bool launch_band(GpuPath *path, GpuBand *band, Error *error)
{
    static const cl_uint zeros[GPU_COUNTERS];
    return write_without_waiting(path, path->on_device->counters, zeros, sizeof zeros, error) &&
           gpu_passes_launch(&path->passes, path->session, &band->of, band->pixels.device, band->traced, error);
}

static void forget_events(GpuBand *band)
{
    cl_event *events[] = {&band->traced[0], &band->traced[1], &band->read};
    for (size_t i = 0; i < sizeof events / sizeof *events; i++) {
        if (*events[i])
            clReleaseEvent(*events[i]);
        *events[i] = NULL;
    }
}

static bool begin_picture(const GpuPath *path, Error *error)
{
    return gpu_passes_begin(&path->passes, path->session, path->on_device, path->parameters, error);
}

/* The program is kept when each kernel has run: some devices compile a kernel only then. */
static bool warm_up(GpuPath *path, RenderReport *report, Error *error)
{
    double start = clock_ms();
    GpuBand *band = &path->bands[0];
    band->of = path->parameters[0];
    band->of.band_rows = 0;
    bool ok = begin_picture(path, error) && launch_band(path, band, error) &&
              opencl_ok(error, clFinish(path->session->queue), "clFinish");
    forget_events(band);
    if (ok)
        opencl_keep(path->session);
    report->compile_ms += clock_ms() - start;
    return ok;
}

static void take_parameters(GpuPath *path, Parameters parameters)
{
    parameters.first_column = path->region.column;
    parameters.band_columns = path->region.columns;
    path->parameters[0] = path->parameters[1] = parameters;
    if (path->session->adaptive) {
        path->parameters[0].grid = 1;
        path->parameters[1].grid = adaptive_samples(parameters.grid);
    }
}

bool gpu_path_make(GpuPath *path, OpenclSession *session, const SceneOnDevice *on_device, Parameters parameters,
                   double *linear, const Region *region, RenderReport *report, Error *error)
{
    *path = (GpuPath){.session = session, .on_device = on_device, .region = *region};
    take_parameters(path, parameters);
    size_t columns = (size_t)region->columns;
    size_t rows = gpu_passes_most(session, &parameters) / columns / GPU_GROUP_ACROSS * GPU_GROUP_ACROSS;
    rows = rows > GPU_GROUP_ACROSS ? rows : GPU_GROUP_ACROSS;
    path->most_rows = rows < (size_t)region->rows ? (int)rows : region->rows;
    size_t pixels = columns * (size_t)path->most_rows;
    for (int i = 0; i < GPU_BANDS; i++)
        if (!opencl_pixels_make(&path->bands[i].pixels, session, pixels, linear, error))
            return false;
    return gpu_passes_make(&path->passes, session, on_device, &parameters, pixels, error) &&
           warm_up(path, report, error);
}

void gpu_path_free(GpuPath *path)
{
    for (int i = 0; i < GPU_BANDS; i++) {
        forget_events(&path->bands[i]);
        opencl_pixels_free(&path->bands[i].pixels);
    }
    gpu_passes_free(&path->passes);
    *path = (GpuPath){0};
}

/* --- A picture --- */

static bool read_without_waiting(const GpuPath *path, cl_mem buffer, size_t bytes, void *data, cl_event *done,
                                 Error *error)
{
    return opencl_ok(error, clEnqueueReadBuffer(path->session->queue, buffer, CL_FALSE, 0, bytes, data, 0, NULL, done),
                     "clEnqueueReadBuffer");
}

static bool read_counts(const GpuPath *path, GpuBand *band, Error *error)
{
    for (int i = 0; i < gpu_passes_counts(path->session); i++)
        if (!read_without_waiting(path, path->passes.counts[i], sizeof(cl_uint), &band->counts[i], NULL, error))
            return false;
    return true;
}

static bool begin_band(GpuPath *path, GpuBand *band, Error *error)
{
    size_t bytes = opencl_pixels_bytes(path->session, &band->of);
    return launch_band(path, band, error) &&
           read_without_waiting(path, path->on_device->counters, sizeof band->counters, band->counters, NULL, error) &&
           read_counts(path, band, error) &&
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
    report->trace_ms += ms_between(band->traced[0], band->traced[1]);
    report->readback_ms += ms_between(band->read, band->read);
    forget_events(band);
    opencl_add_counters(band->counters, report);
    report->exact_pixels += band->counts[GPU_DOUBTS] + (uint64_t)band->counts[GPU_REFINED_DOUBTS];
    report->refined_pixels += band->counts[GPU_REFINED];
    const Region part = opencl_pixels_part(&band->of, &path->region);
    opencl_pixels_take(&band->pixels, path->session, &part);
    return sink.band(sink.user, part.row, part.rows, band->pixels.rgb, report, error);
}

/* The next band's height, from the last one's time: whole groups. */
static int next_rows(const GpuPath *path, int rows, double ms)
{
    double factor = ms > 0 ? BAND_MS / ms : GROWTH;
    factor = factor > GROWTH ? GROWTH : factor;
    int next = (int)(rows * factor) / GPU_GROUP_ACROSS * GPU_GROUP_ACROSS;
    next = next > GPU_GROUP_ACROSS ? next : GPU_GROUP_ACROSS;
    return next < path->most_rows ? next : path->most_rows;
}

/* Of a first band of adaptive sampling, a quarter of the pixels may need more samples. */
static int first_rows(const GpuPath *path)
{
    const Parameters *parameters = path->parameters;
    long grid = parameters[0].grid, samples = path->session->adaptive ? 1 + parameters[1].grid / 4 : grid * grid;
    long row = path->region.columns * samples;
    long rows = FIRST_SAMPLES / row / GPU_GROUP_ACROSS * GPU_GROUP_ACROSS;
    rows = rows > GPU_GROUP_ACROSS ? rows : GPU_GROUP_ACROSS;
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
            band->of = path->parameters[0];
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
    bool ok = begin_picture(path, error) && render_bands(path, sink, report, error);
    if (!ok)
        clFinish(path->session->queue); /* nothing may be written to what is freed next */
    for (int i = 0; i < GPU_BANDS; i++)
        forget_events(&path->bands[i]);
    return ok;
}
