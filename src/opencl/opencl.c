/* The OpenCL backend: renders a scene band by band, the height of a band by the time that the last one took. */
#include "opencl/opencl.h"

#include "opencl/opencl_gpu.h"
#include "opencl/opencl_move.h"
#include "opencl/opencl_refine.h"
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
        rows = rows / 2 / least * least;
    return rows < most ? rows : most;
}

struct OpenclScene {
    OpenclSession session;
    PrunedScene pruned;
    SceneOnDevice on_device;
    Region region; /* what is wanted of the picture */
    Region blocks; /* what is rendered: the region, and what else its blocks hold */
    int most_rows; /* of a band */
    Pixels pixels; /* of a band */
    Refinement refinement;
    cl_kernel kernel;
    GpuPath gpu;         /* of the kernel for GPUs, in place of the six before it */
    RenderReport report; /* of what is done once */
};

static Parameters parameters_of(const OpenclScene *held)
{
    Parameters parameters = opencl_parameters(&held->pruned.scene);
    parameters.first_column = held->blocks.column;
    parameters.band_columns = held->blocks.columns;
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
    size_t across = (size_t)((band->band_columns + session->block_columns - 1) / session->block_columns);
    size_t down = (size_t)((band->band_rows + session->block_rows - 1) / session->block_rows);
    band->grid = session->adaptive ? 1 : grid;
    if (!opencl_launch(session, &held->on_device, held->kernel, band, across * down, report, error))
        return false;
    band->grid = session->adaptive ? adaptive_samples(grid) : grid;
    if (session->adaptive &&
        !opencl_refine(session, &held->on_device, held->kernel, &held->refinement, *band, report, error))
        return false;
    return opencl_pixels_read(&held->pixels, session, band, &held->region, report, error);
}

bool opencl_picture(OpenclScene *held, BandSink sink, RenderReport *report, Error *error)
{
    *report = held->report;
    if (held->session.kernel == KERNEL_GPU)
        return gpu_path_picture(&held->gpu, parameters_of(held), sink, report, error);
    Parameters band = parameters_of(held);
    int most = held->most_rows, rows = FIRST_BAND_ROWS < most ? FIRST_BAND_ROWS : most;
    int least = held->session.block_rows > LEAST_BAND_ROWS ? held->session.block_rows : LEAST_BAND_ROWS;
    int end = held->blocks.row + held->blocks.rows;
    for (int row = held->blocks.row; row < end; row += band.band_rows) {
        band.first_row = row;
        band.band_rows = rows < end - row ? rows : end - row;
        const Region part = opencl_pixels_part(&band, &held->region);
        double before = report->trace_ms;
        if (!render_band(held, &band, report, error) ||
            !sink.band(sink.user, part.row, part.rows, held->pixels.rgb, report, error))
            return false;
        rows = next_band(rows, least, most, report->trace_ms - before);
    }
    return true;
}

/* --- What is rendered --- */

/* The region, widened to whole blocks of the picture: what a block's pixels have in common may decide the last bit of
 * their colours, so that a block of a region must be a block of the whole picture. */
static Region blocks_around(const OpenclSession *session, const Region *region, const Screen *screen)
{
    int across = session->block_columns, down = session->block_rows;
    Region blocks = {region->column / across * across, region->row / down * down, 0, 0};
    int right = (region->column + region->columns + across - 1) / across * across;
    int bottom = (region->row + region->rows + down - 1) / down * down;
    blocks.columns = (right < screen->columns ? right : screen->columns) - blocks.column;
    blocks.rows = (bottom < screen->rows ? bottom : screen->rows) - blocks.row;
    return blocks;
}

/* The most rows of a band: whole blocks of at most BAND_BYTES and OPENCL_MAX_ITEMS in all, at least one block. */
static int band_limit(const OpenclSession *session, const Region *blocks)
{
    int pixel_bytes = session->adaptive ? 3 + REFINEMENT_BYTES : 3;
    int rows = BAND_BYTES / (blocks->columns * pixel_bytes);
    int across = (blocks->columns + session->block_columns - 1) / session->block_columns;
    if (rows > OPENCL_MAX_ITEMS / across * session->block_rows)
        rows = OPENCL_MAX_ITEMS / across * session->block_rows;
    if (rows > blocks->rows)
        rows = blocks->rows;
    rows = (rows + session->block_rows - 1) / session->block_rows * session->block_rows;
    return rows;
}

/* Room for a band, here and on the device. */
static bool make_room(OpenclScene *held, const RenderSettings *settings, Error *error)
{
    OpenclSession *session = &held->session;
    held->region = render_region(settings, &held->pruned.scene);
    held->blocks = blocks_around(session, &held->region, &held->pruned.scene.screen);
    held->most_rows = band_limit(session, &held->blocks);
    size_t pixels = (size_t)held->most_rows * (size_t)held->blocks.columns;
    return opencl_pixels_make(&held->pixels, session, pixels, settings->linear, error) &&
           (!session->adaptive || opencl_refinement(&held->refinement, session, pixels, error));
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
    held->kernel = opencl_kernel(&held->session.programs[PROGRAM_MAIN], adaptive ? "render_adaptive" : "render",
                                 arguments, count, error);
    return held->kernel != NULL;
}

/* False, with the way out, where the kernel does not do what the settings or the scene ask for. */
static bool check_settings(const Scene *scene, const RenderSettings *settings, Error *error)
{
    bool plain = settings->kernel == KERNEL_PLAIN, gpu = settings->kernel == KERNEL_GPU;
    const char *name = plain ? "plain" : gpu ? "gpu" : "packet";
    if (!plain && settings->arithmetic != ARITHMETIC_EXACT)
        return error_set(error, ERROR_USAGE, "the %s kernel has no textbook arithmetic; add --kernel plain", name);
    if ((plain || gpu) && settings->lanes > 1)
        return error_set(error, ERROR_USAGE,
                         "the %s kernel traces one ray per work-item; leave out --lanes, or use --kernel packet", name);
    if (plain && scene->adaptive && scene->grid > 1)
        return error_set(error, ERROR_USAGE,
                         "the plain kernel does not sample adaptively; use --sampling uniform:N or --kernel packet");
    if (gpu && settings->precision == PRECISION_DOUBLE)
        return error_set(error, ERROR_USAGE, "the gpu kernel is float's; leave out --precision, or use --kernel plain");
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

/* What a picture takes besides the scene. */
static bool make_rest(OpenclScene *held, const RenderSettings *settings, Error *error)
{
    RenderReport *report = &held->report;
    if (held->session.kernel == KERNEL_GPU) {
        held->blocks = render_region(settings, &held->pruned.scene);
        return gpu_path_make(&held->gpu, &held->session, &held->on_device, parameters_of(held), settings->linear,
                             &held->blocks, report, error);
    }
    return make_room(held, settings, error) && make_kernel(held, error) &&
           opencl_warm_up(&held->session, &held->on_device, held->kernel, parameters_of(held), report, error);
}

/* All that follows the pruning. */
static bool put_on_device(OpenclScene *held, const RenderSettings *settings, Error *error)
{
    return opencl_prepare(&held->session, &held->pruned.scene, settings, &held->on_device, &held->report, error) &&
           make_rest(held, settings, error);
}

static void take_from_device(OpenclScene *held)
{
    if (held->kernel)
        clReleaseKernel(held->kernel);
    held->kernel = NULL;
    opencl_refinement_free(&held->refinement);
    opencl_pixels_free(&held->pixels);
    gpu_path_free(&held->gpu);
    opencl_drop(&held->session);
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
    if (pruned_scene_make(&held->pruned, scene, settings, &held->report, error) && put_on_device(held, settings, error))
        return held;
    opencl_release(held);
    return NULL;
}

OpenclScene *opencl_hold(const Scene *scene, const RenderSettings *settings, Error *error)
{
    return hold(scene, settings, false, error);
}

bool opencl_exchange(OpenclScene *held, const Scene *scene, bool same_faces, const RenderSettings *asked, Error *error)
{
    RenderSettings settings = settings_for_kernel(asked);
    PrunedScene before = held->pruned;
    RenderReport *report = &held->report;
    held->session.notice = settings.notice;
    held->pixels.linear = settings.linear;
    gpu_path_fill(&held->gpu, settings.linear);
    report->build_ms = report->upload_ms = report->device_ms = report->compile_ms = 0;
    memset(report->skipped, 0, sizeof report->skipped);
    bool ok = pruned_scene_make(&held->pruned, scene, &settings, report, error);
    if (ok && same_faces && opencl_move_is_possible(&held->on_device, &before, &held->pruned, &settings, error)) {
        ok = opencl_move(&held->session, &held->on_device, &held->pruned.scene, report, error);
    } else if (ok) {
        take_from_device(held);
        ok = put_on_device(held, &settings, error);
    }
    pruned_scene_free(&before);
    return ok;
}

const RenderReport *opencl_held_report(const OpenclScene *held)
{
    return &held->report;
}

void opencl_release(OpenclScene *held)
{
    if (!held)
        return;
    take_from_device(held);
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
