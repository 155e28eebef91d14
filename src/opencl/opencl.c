/* The OpenCL backend: renders a scene band by band, the height of a band by the time that the last one took. */
#include "opencl/opencl.h"

#include "opencl/opencl_refine.h"
#include "scene/light.h"
#include "trace/adaptive.h"
#include "trace/pruned_scene.h"

#include <stdlib.h>
#include <string.h>

/* So few bytes that their pages, used again, stay in the cache. */
enum { BAND_BYTES = 1 << 20, FIRST_BAND_ROWS = 64, LEAST_BAND_ROWS = 16 };

#define BAND_MS 50.0 /* a band should take about this long: progress is smooth, an interrupt is soon obeyed */

/* The next band's height, from the last one's time: whole blocks, of `least` rows, within the buffer. */
static int next_band(int rows, int least, int most, double ms)
{
    if (ms * 2 < BAND_MS)
        rows *= 2;
    else if (ms > BAND_MS * 2 && rows >= 2 * least)
        rows /= 2;
    return rows < most ? rows : most;
}

/* A band on its way: what the device wrote, the bytes that the
 * sink gets, and the linear colours where they are wanted. */
typedef struct Pixels {
    cl_mem device;
    void *read;         /* bytes, or reals of the session's precision */
    unsigned char *rgb; /* the same as `read` where that is bytes */
    double *linear;     /* the whole picture's, or NULL */
    int most_rows;
} Pixels;

struct OpenclScene {
    OpenclSession session;
    PrunedScene pruned;
    SceneOnDevice on_device;
    Pixels pixels;
    Refinement refinement;
    cl_kernel kernel;
    RenderReport report; /* of what is done once */
};

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

static Parameters parameters_of(const OpenclScene *held)
{
    Parameters parameters = opencl_parameters(&held->pruned.scene);
    parameters.no_skip = (int)held->session.no_skip;
    /* A bounce is weak where it cannot change a byte: that needs bytes, and pixels of one path each. */
    if (held->session.linear || held->session.adaptive)
        parameters.no_skip |= 1 << SKIP_WEAK_BOUNCE;
    parameters.shift = held->session.shift;
    if (held->session.adaptive)
        parameters.generator = adaptive_generator(adaptive_samples(held->pruned.scene.grid));
    return parameters;
}

/* In an adaptive session the kernel renders the pixels' centres first, then those pixels that need more. */
static bool render_band(OpenclScene *held, Parameters *band, RenderReport *report, Error *error)
{
    OpenclSession *session = &held->session;
    int grid = held->pruned.scene.grid;
    size_t across = (size_t)((band->columns + session->block_columns - 1) / session->block_columns);
    size_t down = (size_t)((band->band_rows + session->block_rows - 1) / session->block_rows);
    band->grid = session->adaptive ? 1 : grid;
    if (!opencl_launch(session, &held->on_device, held->kernel, band, across * down, report, error))
        return false;
    band->grid = session->adaptive ? adaptive_samples(grid) : grid;
    if (session->adaptive &&
        !opencl_refine(session, &held->on_device, held->kernel, &held->refinement, *band, report, error))
        return false;
    return read_band(session, &held->pixels, band, report, error);
}

bool opencl_picture(OpenclScene *held, BandSink sink, RenderReport *report, Error *error)
{
    *report = held->report;
    Parameters parameters = parameters_of(held);
    int most = held->pixels.most_rows, band = FIRST_BAND_ROWS < most ? FIRST_BAND_ROWS : most;
    int least = held->session.block_rows > LEAST_BAND_ROWS ? held->session.block_rows : LEAST_BAND_ROWS;
    for (int row = 0; row < parameters.rows; row += parameters.band_rows) {
        parameters.first_row = row;
        parameters.band_rows = band < parameters.rows - row ? band : parameters.rows - row;
        double before = report->trace_ms;
        if (!render_band(held, &parameters, report, error) ||
            !sink.band(sink.user, row, parameters.band_rows, held->pixels.rgb, report, error))
            return false;
        band = next_band(band, least, most, report->trace_ms - before);
    }
    return true;
}

/* The most rows of a band: whole blocks of at most BAND_BYTES and OPENCL_MAX_ITEMS in all, at least one block. */
static int band_limit(const OpenclSession *session, const Scene *scene)
{
    int pixel_bytes = session->adaptive ? 3 + REFINEMENT_BYTES : 3;
    int rows = BAND_BYTES / (scene->screen.columns * pixel_bytes);
    int across = (scene->screen.columns + session->block_columns - 1) / session->block_columns;
    if (rows > OPENCL_MAX_ITEMS / across * session->block_rows)
        rows = OPENCL_MAX_ITEMS / across * session->block_rows;
    if (rows > scene->screen.rows)
        rows = scene->screen.rows;
    rows = (rows + session->block_rows - 1) / session->block_rows * session->block_rows;
    return rows;
}

/* Room for a band, here and on the device. */
static bool make_pixels(OpenclScene *held, double *linear, Error *error)
{
    OpenclSession *session = &held->session;
    Pixels *pixels = &held->pixels;
    pixels->linear = linear;
    pixels->most_rows = band_limit(session, &held->pruned.scene);
    size_t values = (size_t)pixels->most_rows * (size_t)held->pruned.scene.screen.columns * 3,
           bytes = values * value_bytes(session);
    pixels->device = opencl_buffer(session, CL_MEM_READ_WRITE, bytes, NULL, error);
    if (!pixels->device)
        return false;
    pixels->read = malloc(bytes);
    pixels->rgb = session->linear ? malloc(values) : pixels->read;
    return ((pixels->read && pixels->rgb) || error_memory(error, "a band of the picture")) &&
           (!session->adaptive || opencl_refinement(&held->refinement, session, values / 3, error));
}

static bool make_kernel(OpenclScene *held, Error *error)
{
    const SceneOnDevice *on_device = &held->on_device;
    /* The last two are for render_adaptive only. */
    cl_mem arguments[] = {on_device->parameters, on_device->faces,       on_device->face_rows, on_device->planes,
                          on_device->materials,  on_device->lights,      on_device->view,      held->pixels.device,
                          on_device->counters,   on_device->tree_floats, on_device->tree_ints, held->refinement.flags,
                          held->refinement.list};
    bool adaptive = held->session.adaptive;
    int count = (int)(sizeof arguments / sizeof arguments[0]) - (adaptive ? 0 : 2);
    held->kernel = opencl_kernel(&held->session, adaptive ? "render_adaptive" : "render", arguments, count, error);
    return held->kernel != NULL;
}

/* False, with the way out, where the kernel does not do what the settings or the scene ask for. */
static bool check_settings(const Scene *scene, const RenderSettings *settings, Error *error)
{
    if (settings->kernel == KERNEL_PACKET)
        return settings->arithmetic == ARITHMETIC_EXACT ||
               error_set(error, ERROR_USAGE, "the packet kernel has no textbook arithmetic; add --kernel plain");
    if (settings->lanes > 1)
        return error_set(error, ERROR_USAGE,
                         "the plain kernel traces one ray per work-item; leave out --lanes, or use --kernel packet");
    if (scene->adaptive && scene->grid > 1)
        return error_set(error, ERROR_USAGE,
                         "the plain kernel does not sample adaptively; use --sampling uniform:N or --kernel packet");
    return true;
}

/* The plain kernel leaves out only what its text says, and so does the host for it; a tree is a matter of --accel. */
static RenderSettings settings_for_kernel(const RenderSettings *settings)
{
    RenderSettings own = *settings;
    if (own.kernel == KERNEL_PLAIN)
        own.no_skip |= ~(1u << SKIP_TREE);
    return own;
}

/* `single`: for one picture only. */
static OpenclScene *hold(const Scene *scene, const RenderSettings *asked, bool single, Error *error)
{
    if (!check_settings(scene, asked, error))
        return NULL;
    RenderSettings own = settings_for_kernel(asked), *settings = &own;
    OpenclScene *held = calloc(1, sizeof *held);
    if (!held) {
        error_memory(error, "a scene on a device");
        return NULL;
    }
    held->session = (OpenclSession){
        .single = single, .linear = settings->linear != NULL, .adaptive = scene->adaptive && scene->grid > 1};
    if (pruned_scene_make(&held->pruned, scene, settings, &held->report, error) &&
        opencl_prepare(&held->session, &held->pruned.scene, settings, &held->on_device, &held->report, error) &&
        make_pixels(held, settings->linear, error) && make_kernel(held, error) &&
        opencl_warm_up(&held->session, &held->on_device, held->kernel, parameters_of(held), &held->report, error))
        return held;
    opencl_release(held);
    return NULL;
}

OpenclScene *opencl_hold(const Scene *scene, const RenderSettings *settings, Error *error)
{
    return hold(scene, settings, false, error);
}

const RenderReport *opencl_held_report(const OpenclScene *held)
{
    return &held->report;
}

void opencl_release(OpenclScene *held)
{
    if (!held)
        return;
    if (held->kernel)
        clReleaseKernel(held->kernel);
    opencl_refinement_free(&held->refinement);
    if (held->pixels.rgb != held->pixels.read)
        free(held->pixels.rgb);
    free(held->pixels.read);
    opencl_close(&held->session);
    pruned_scene_free(&held->pruned);
    free(held);
}

bool opencl_render(const Scene *scene, const RenderSettings *settings, BandSink sink, RenderReport *report,
                   Error *error)
{
    memset(report, 0, sizeof *report);
    OpenclScene *held = hold(scene, settings, true, error);
    bool ok = held && opencl_picture(held, sink, report, error);
    opencl_release(held);
    return ok;
}
