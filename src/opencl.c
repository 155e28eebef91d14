/* The OpenCL backend: renders a scene band by band, the height of a band by the time that the last one took. */
#include "opencl.h"

#include "adaptive.h"
#include "light.h"
#include "opencl_refine.h"
#include "skip.h"

#include <stdlib.h>
#include <string.h>

enum { BAND_BYTES = 1 << 20, FIRST_BAND_ROWS = 64 }; /* so few that the pages, used again, stay in the cache */

#define BAND_MS 50.0 /* a band should take about this long: progress is smooth, an interrupt is soon obeyed */

/* The next band's height, from the last one's time: whole tiles, within the buffer. */
static int next_band(int rows, int most, double ms)
{
    if (ms * 2 < BAND_MS)
        rows *= 2;
    else if (ms > BAND_MS * 2 && rows >= 32)
        rows /= 2;
    return rows < most ? rows : most;
}

/* A band on its way: what the device wrote, the bytes that the sink gets, and the linear colours where they are wanted. */
typedef struct Pixels {
    cl_mem device;
    void *read;         /* bytes, or reals of the session's precision */
    unsigned char *rgb; /* the same as `read` where that is bytes */
    double *linear;     /* the whole picture's, or NULL */
} Pixels;

/* Bytes of a value on the device. */
static size_t value_bytes(const OpenclSession *session)
{
    return !session->linear ? 1 : session->precision == PRECISION_DOUBLE ? sizeof(double) : sizeof(float);
}

static void take_linear(const OpenclSession *session, const Pixels *pixels, const Parameters *band)
{
    double *out = pixels->linear + (size_t)band->first_row * (size_t)band->columns * 3;
    size_t count = (size_t)band->band_rows * (size_t)band->columns * 3;
    for (size_t i = 0; i < count; i++) {
        out[i] =
            session->precision == PRECISION_DOUBLE ? ((double *)pixels->read)[i] : (double)((float *)pixels->read)[i];
        pixels->rgb[i] = colour_to_byte(out[i]);
    }
}

static bool read_band(OpenclSession *session, const Pixels *pixels, const Parameters *band, RenderReport *report,
                      Error *error)
{
    size_t values = (size_t)band->band_rows * (size_t)band->columns * 3;
    if (!opencl_read(session, pixels->device, values * value_bytes(session), pixels->read, report, error))
        return false;
    if (pixels->linear)
        take_linear(session, pixels, band);
    return true;
}

/* In an adaptive session the kernel renders the pixels' centres first, then those pixels that need more. */
static bool render_bands(OpenclSession *session, const Scene *scene, const SceneOnDevice *on_device, cl_kernel kernel,
                         const Refinement *refinement, const Pixels *pixels, int most_rows, BandSink sink, RenderReport *report,
                         Error *error)
{
    Parameters parameters = opencl_parameters(scene);
    parameters.no_skip = (int)session->no_skip;
    if (session->adaptive)
        parameters.generator = adaptive_generator(adaptive_samples(scene->grid));
    size_t tiles_across = (size_t)((parameters.columns + session->tile_columns - 1) / session->tile_columns);
    int band = FIRST_BAND_ROWS < most_rows ? FIRST_BAND_ROWS : most_rows;
    if (!opencl_warm_up(session, on_device, kernel, parameters, report, error))
        return false;
    for (int row = 0; row < parameters.rows; row += parameters.band_rows) {
        parameters.first_row = row;
        parameters.band_rows = band < parameters.rows - row ? band : parameters.rows - row;
        parameters.grid = session->adaptive ? 1 : scene->grid;
        size_t tiles_down = (size_t)((parameters.band_rows + session->tile_rows - 1) / session->tile_rows);
        double before = report->trace_ms;
        size_t items = (tiles_across * tiles_down + (size_t)session->tiles_per_item - 1) / (size_t)session->tiles_per_item;
        if (!opencl_launch(session, on_device, kernel, &parameters, items, report, error))
            return false;
        parameters.grid = session->adaptive ? adaptive_samples(scene->grid) : scene->grid;
        if ((session->adaptive && !opencl_refine(session, on_device, kernel, refinement, parameters, report, error)) ||
            !read_band(session, pixels, &parameters, report, error) ||
            !sink.band(sink.user, row, parameters.band_rows, pixels->rgb, report, error))
            return false;
        band = next_band(band, most_rows, report->trace_ms - before);
    }
    return true;
}

/* The most rows of a band: whole tiles of at most BAND_BYTES and OPENCL_MAX_ITEMS in all, at least one tile. */
static int band_limit(const OpenclSession *session, const Scene *scene)
{
    int pixel_bytes = session->adaptive ? 3 + REFINEMENT_BYTES : 3;
    int rows = BAND_BYTES / (scene->screen.columns * pixel_bytes);
    int tiles_across = (scene->screen.columns + session->tile_columns - 1) / session->tile_columns;
    if (rows > OPENCL_MAX_ITEMS / tiles_across * session->tile_rows)
        rows = OPENCL_MAX_ITEMS / tiles_across * session->tile_rows;
    if (rows > scene->screen.rows)
        rows = scene->screen.rows;
    rows = (rows + session->tile_rows - 1) / session->tile_rows * session->tile_rows;
    return rows;
}

static bool render_session(OpenclSession *session, const Scene *scene, const RenderSettings *settings, BandSink sink,
                           RenderReport *report, Error *error)
{
    SceneOnDevice on_device;
    if (!opencl_prepare(session, "render", scene, settings, &on_device, report, error))
        return false;
    int most_rows = band_limit(session, scene);
    size_t values = (size_t)most_rows * (size_t)scene->screen.columns * 3, bytes = values * value_bytes(session);
    Pixels pixels = {.device = opencl_buffer(session, CL_MEM_READ_WRITE, bytes, NULL, error),
                     .linear = settings->linear};
    if (!pixels.device)
        return false;
    pixels.read = malloc(bytes);
    pixels.rgb = session->linear ? malloc(values) : pixels.read;
    Refinement refinement = {0};
    bool ok = ((pixels.read && pixels.rgb) || error_memory(error, "a band of the picture")) &&
              (!session->adaptive || opencl_refinement(&refinement, session, values / 3, error));
    /* The last two are for render_adaptive only. */
    cl_mem arguments[] = {on_device.parameters, on_device.faces,       on_device.edges,     on_device.planes,
                          on_device.materials,  on_device.lights,      on_device.view,      pixels.device,
                          on_device.counters,   on_device.tree_floats, on_device.tree_ints, refinement.flags,
                          refinement.list};
    int argument_count = (int)(sizeof arguments / sizeof arguments[0]) - (session->adaptive ? 0 : 2);
    const char *name = session->adaptive ? "render_adaptive" : "render";
    cl_kernel kernel = ok ? opencl_kernel(session, name, arguments, argument_count, error) : NULL;
    ok = kernel && render_bands(session, scene, &on_device, kernel, &refinement, &pixels, most_rows, sink, report, error);
    if (kernel)
        clReleaseKernel(kernel);
    opencl_refinement_free(&refinement);
    if (pixels.rgb != pixels.read)
        free(pixels.rgb);
    free(pixels.read);
    return ok;
}

bool opencl_render(const Scene *scene, const RenderSettings *settings, BandSink sink, RenderReport *report,
                   Error *error)
{
    memset(report, 0, sizeof *report);
    OpenclSession session = {.linear = settings->linear != NULL, .adaptive = scene->adaptive && scene->grid > 1};
    LeanScene lean;
    bool ok = lean_scene_make(&lean, scene, settings, report, error) &&
              render_session(&session, &lean.scene, settings, sink, report, error);
    opencl_close(&session);
    lean_scene_free(&lean);
    return ok;
}
