/* The OpenCL backend: uploads a scene, renders it band by band, or casts rays at it. */
#include "opencl.h"

#include "clock.h"
#include "opencl_program.h"
#include "opencl_scene.h"
#include "opencl_tree.h"

#include <stdlib.h>
#include <string.h>

/* PoCL compiles a kernel once more for launches of more than 65535 work-groups. */
enum { BAND_BYTES = 32 << 20, BAND_ITEMS = 65535, FIRST_BAND_ROWS = 64, COUNTERS = COUNTER_STRIPES * COUNTER_STRIDE };

#define BAND_MS 50.0 /* a band should take about this long: progress is smooth, an interrupt is soon obeyed */

/* The buffers of a scene on the device. */
typedef struct Upload {
    cl_mem parameters, faces, edges, planes, materials, lights, view, counters, boxes, children;
} Upload;

/* Up to this many faces are asked one after the other: a tree would cost more than it saves. */
enum { SMALL_SCENE = 16 };

/* The scene's tree, and its faces in the order of the leaves. */
typedef struct Tree {
    Bvh bvh;
    WideTree wide;
    TreeOptions options;
} Tree;

static Parameters parameters_of(const Scene *scene)
{
    return (Parameters){
        .columns = scene->screen.columns,
        .rows = scene->screen.rows,
        .grid = scene->grid,
        .face_count = scene->face_count,
        .light_count = scene->light_count,
        .max_bounces = scene->shading.max_bounces,
        .shadow_ambient = scene->shading.shadow == SHADOW_AMBIENT,
        .viewer_ray = scene->shading.viewer == VIEWER_RAY,
    };
}

static void tree_free(Tree *tree)
{
    bvh_free(&tree->bvh);
    wide_tree_free(&tree->wide);
}

/* The stack of a walk, in steps so that few scenes need kernels of their own. */
static int stack_size(const WideTree *tree)
{
    int needed = 1 + tree->depth * (tree->width - 1), size = 128;
    while (size < needed)
        size *= 2;
    return size;
}

static bool build_tree(const OpenclSession *session, const Scene *scene, const RenderSettings *settings, Tree *tree,
                       RenderReport *report, Error *error)
{
    double start = clock_ms();
    *tree = (Tree){.options = {.kind = ACCEL_NONE, .node_width = 1, .stack_size = 1}};
    bool small = settings->accel == ACCEL_AUTO && scene->face_count <= SMALL_SCENE;
    if (settings->accel == ACCEL_NONE || small || scene->face_count == 0)
        return true;
    int width = session->lanes > 4 ? session->lanes : 4;
    bool ok = bvh_build(&tree->bvh, scene, settings->threads, error) && wide_tree_build(&tree->wide, &tree->bvh, width, error);
    if (ok)
        tree->options = (TreeOptions){ACCEL_BVH, width, stack_size(&tree->wide)};
    report->build_ms = clock_ms() - start;
    return ok;
}

static bool upload(OpenclSession *session, const Scene *scene, const Tree *tree, Upload *on_device, RenderReport *report,
                   Error *error)
{
    double start = clock_ms();
    DeviceScene packed;
    Precision wide = session->wide_is_double ? PRECISION_DOUBLE : PRECISION_FLOAT;
    bool ok = device_scene_pack(&packed, scene, tree->bvh.order, session->precision, wide, error);
    size_t faces = (size_t)(scene->face_count > 0 ? scene->face_count : 1);
    size_t children = (size_t)tree->wide.node_count * (size_t)tree->wide.width;
    const cl_mem_flags read = CL_MEM_READ_ONLY;
    ok = ok && (on_device->parameters = opencl_buffer(session, read, sizeof(Parameters), NULL, error)) &&
         (on_device->faces = opencl_buffer(session, read, faces * sizeof(FaceRecord), packed.faces, error)) &&
         (on_device->edges = opencl_buffer(session, read, reals_bytes(&packed.edges), packed.edges.data, error)) &&
         (on_device->planes = opencl_buffer(session, read, reals_bytes(&packed.planes), packed.planes.data, error)) &&
         (on_device->materials = opencl_buffer(session, read, reals_bytes(&packed.materials), packed.materials.data, error)) &&
         (on_device->lights = opencl_buffer(session, read, reals_bytes(&packed.lights), packed.lights.data, error)) &&
         (on_device->view = opencl_buffer(session, read, reals_bytes(&packed.view), packed.view.data, error)) &&
         (on_device->counters = opencl_buffer(session, CL_MEM_READ_WRITE, COUNTERS * sizeof(cl_uint), NULL, error)) &&
         (on_device->boxes = opencl_buffer(session, read, (children > 0 ? 6 * children : 1) * sizeof(float), tree->wide.boxes,
                                           error)) &&
         (on_device->children = opencl_buffer(session, read, (children > 0 ? children : 1) * sizeof(int), tree->wide.children,
                                              error));
    device_scene_free(&packed);
    report->upload_ms += clock_ms() - start;
    return ok;
}

/* From a scene to kernels and buffers ready to run. */
static bool prepare(OpenclSession *session, const Scene *scene, const RenderSettings *settings, Upload *on_device,
                    RenderReport *report, Error *error)
{
    Tree tree = {0};
    bool ok = opencl_open(session, settings, report, error) &&
              build_tree(session, scene, settings, &tree, report, error) &&
              opencl_build(session, tree.options, report, error) &&
              upload(session, scene, &tree, on_device, report, error);
    tree_free(&tree);
    return ok;
}

static bool write_launch(OpenclSession *session, const Upload *on_device, const Parameters *parameters, Error *error)
{
    static const cl_uint zeros[COUNTERS];
    return opencl_ok(error,
                     clEnqueueWriteBuffer(session->queue, on_device->parameters, CL_TRUE, 0, sizeof *parameters, parameters,
                                          0, NULL, NULL),
                     "clEnqueueWriteBuffer") &&
           opencl_ok(error,
                     clEnqueueWriteBuffer(session->queue, on_device->counters, CL_TRUE, 0, sizeof zeros, zeros, 0, NULL, NULL),
                     "clEnqueueWriteBuffer");
}

static bool read_back(OpenclSession *session, cl_mem buffer, size_t bytes, void *data, RenderReport *report, Error *error)
{
    double start = clock_ms();
    cl_int status = clEnqueueReadBuffer(session->queue, buffer, CL_TRUE, 0, bytes, data, 0, NULL, NULL);
    report->readback_ms += clock_ms() - start;
    return opencl_ok(error, status, "clEnqueueReadBuffer");
}

static bool add_counters(OpenclSession *session, const Upload *on_device, RenderReport *report, Error *error)
{
    cl_uint counters[COUNTERS];
    if (!read_back(session, on_device->counters, sizeof counters, counters, report, error))
        return false;
    uint64_t sums[COUNTER_KINDS] = {0};
    for (int i = 0; i < COUNTERS; i++)
        if (i % COUNTER_STRIDE < COUNTER_KINDS)
            sums[i % COUNTER_STRIDE] += counters[i];
    report->rays.primary += sums[COUNT_PRIMARY];
    report->rays.shadow += sums[COUNT_SHADOW];
    report->rays.reflection += sums[COUNT_REFLECTION];
    report->skipped_light_behind += sums[COUNT_LIGHT_BEHIND];
    report->face_tests += sums[COUNT_FACE_TESTS];
    report->box_tests += sums[COUNT_BOX_TESTS];
    return true;
}

static bool launch(OpenclSession *session, const Upload *on_device, cl_kernel kernel, const Parameters *parameters,
                   size_t items, RenderReport *report, Error *error)
{
    if (!write_launch(session, on_device, parameters, error))
        return false;
    double start = clock_ms();
    bool ok = opencl_run(session, kernel, items, error);
    report->trace_ms += clock_ms() - start;
    return ok && add_counters(session, on_device, report, error);
}

/* A launch without work: some devices compile a kernel when it first runs, and that is no part of tracing. */
static bool warm_up(OpenclSession *session, const Upload *on_device, cl_kernel kernel, Parameters parameters,
                    RenderReport *report, Error *error)
{
    double start = clock_ms();
    parameters.band_rows = 0;
    parameters.ray_count = 0;
    bool ok = write_launch(session, on_device, &parameters, error) && opencl_run(session, kernel, 1, error);
    report->compile_ms += clock_ms() - start;
    return ok;
}

/* The next band's height, from the last one's time: whole tiles, within the buffer. */
static int next_band(int rows, int most, double ms)
{
    if (ms * 2 < BAND_MS)
        rows *= 2;
    else if (ms > BAND_MS * 2 && rows >= 32)
        rows /= 2;
    return rows < most ? rows : most;
}

static bool render_bands(OpenclSession *session, const Scene *scene, const Upload *on_device, cl_kernel kernel,
                         cl_mem pixels, unsigned char *rgb, int most_rows, BandSink sink, RenderReport *report, Error *error)
{
    Parameters parameters = parameters_of(scene);
    size_t row_bytes = (size_t)parameters.columns * 3;
    size_t tiles_across = (size_t)((parameters.columns + session->tile_columns - 1) / session->tile_columns);
    int band = FIRST_BAND_ROWS < most_rows ? FIRST_BAND_ROWS : most_rows;
    if (!warm_up(session, on_device, kernel, parameters, report, error))
        return false;
    for (int row = 0; row < parameters.rows; row += parameters.band_rows) {
        parameters.first_row = row;
        parameters.band_rows = band < parameters.rows - row ? band : parameters.rows - row;
        size_t tiles_down = (size_t)((parameters.band_rows + session->tile_rows - 1) / session->tile_rows);
        double before = report->trace_ms;
        if (!launch(session, on_device, kernel, &parameters, tiles_across * tiles_down, report, error) ||
            !read_back(session, pixels, (size_t)parameters.band_rows * row_bytes, rgb, report, error) ||
            !sink.band(sink.user, row, parameters.band_rows, rgb, report, error))
            return false;
        band = next_band(band, most_rows, report->trace_ms - before);
    }
    return true;
}

/* The most rows of a band: whole tiles of at most BAND_BYTES and BAND_ITEMS in all, at least one tile. */
static int band_limit(const OpenclSession *session, const Scene *scene)
{
    int rows = BAND_BYTES / (scene->screen.columns * 3);
    int tiles_across = (scene->screen.columns + session->tile_columns - 1) / session->tile_columns;
    if (rows > BAND_ITEMS / tiles_across * session->tile_rows)
        rows = BAND_ITEMS / tiles_across * session->tile_rows;
    if (rows > scene->screen.rows)
        rows = scene->screen.rows;
    rows = (rows + session->tile_rows - 1) / session->tile_rows * session->tile_rows;
    return rows;
}

static bool render_session(OpenclSession *session, const Scene *scene, const RenderSettings *settings, BandSink sink,
                           RenderReport *report, Error *error)
{
    Upload on_device;
    if (!prepare(session, scene, settings, &on_device, report, error))
        return false;
    int most_rows = band_limit(session, scene);
    size_t bytes = (size_t)most_rows * (size_t)scene->screen.columns * 3;
    cl_mem pixels = opencl_buffer(session, CL_MEM_WRITE_ONLY, bytes, NULL, error);
    if (!pixels)
        return false;
    unsigned char *rgb = malloc(bytes);
    if (!rgb)
        return error_memory(error, "a band of the picture");
    cl_mem arguments[] = {on_device.parameters, on_device.faces,  on_device.edges, on_device.planes,
                          on_device.materials,  on_device.lights, on_device.view,  pixels,
                          on_device.counters,   on_device.boxes,  on_device.children};
    cl_kernel kernel = opencl_kernel(session, "render", arguments, sizeof arguments / sizeof arguments[0], error);
    bool ok = kernel && render_bands(session, scene, &on_device, kernel, pixels, rgb, most_rows, sink, report, error);
    if (kernel)
        clReleaseKernel(kernel);
    free(rgb);
    return ok;
}

bool opencl_render(const Scene *scene, const RenderSettings *settings, BandSink sink, RenderReport *report, Error *error)
{
    memset(report, 0, sizeof *report);
    OpenclSession session = {0};
    bool ok = render_session(&session, scene, settings, sink, report, error);
    opencl_close(&session);
    return ok;
}

/* Rays and hits in the device's types; the caller frees all three. */
typedef struct CastArrays {
    void *rays, *t;
    cl_int *faces;
    size_t ray_bytes, t_bytes;
} CastArrays;

static bool cast_arrays(CastArrays *arrays, const OpenclSession *session, const double *rays, long count, Error *error)
{
    size_t values = (size_t)count * 6;
    arrays->ray_bytes = session->wide_is_double ? sizeof(double) : sizeof(float);
    arrays->t_bytes = session->wide_is_double ? sizeof(double) : sizeof(float);
    arrays->rays = malloc(values * arrays->ray_bytes);
    arrays->faces = malloc((size_t)count * sizeof(cl_int));
    arrays->t = malloc((size_t)count * arrays->t_bytes);
    if (!arrays->rays || !arrays->faces || !arrays->t)
        return error_memory(error, "the rays");
    for (size_t i = 0; i < values; i++)
        if (session->wide_is_double)
            ((double *)arrays->rays)[i] = rays[i];
        else
            ((float *)arrays->rays)[i] = (float)rays[i];
    return true;
}

static bool cast_session(OpenclSession *session, const Scene *scene, const Upload *on_device, CastArrays *arrays, long count,
                         RenderReport *report, Error *error)
{
    size_t rays = (size_t)count;
    cl_mem ray_buffer, face_buffer, t_buffer;
    if (!(ray_buffer = opencl_buffer(session, CL_MEM_READ_ONLY, rays * 6 * arrays->ray_bytes, arrays->rays, error)) ||
        !(face_buffer = opencl_buffer(session, CL_MEM_WRITE_ONLY, rays * sizeof(cl_int), NULL, error)) ||
        !(t_buffer = opencl_buffer(session, CL_MEM_WRITE_ONLY, rays * arrays->t_bytes, NULL, error)))
        return false;
    cl_mem arguments[] = {on_device->parameters, on_device->faces, on_device->edges,    on_device->planes, ray_buffer,
                          face_buffer,           t_buffer,         on_device->counters, on_device->boxes,  on_device->children};
    cl_kernel kernel = opencl_kernel(session, "cast", arguments, sizeof arguments / sizeof arguments[0], error);
    if (!kernel)
        return false;
    Parameters parameters = parameters_of(scene);
    parameters.ray_count = (int)count;
    size_t items = (rays + (size_t)session->lanes - 1) / (size_t)session->lanes;
    bool ok = launch(session, on_device, kernel, &parameters, items, report, error) &&
              read_back(session, face_buffer, rays * sizeof(cl_int), arrays->faces, report, error) &&
              read_back(session, t_buffer, rays * arrays->t_bytes, arrays->t, report, error);
    clReleaseKernel(kernel);
    return ok;
}

bool opencl_cast(const Scene *scene, const RenderSettings *settings, const double *rays, long count, CastHit *hits,
                 RenderReport *report, Error *error)
{
    memset(report, 0, sizeof *report);
    if (count == 0)
        return true;
    OpenclSession session = {0};
    CastArrays arrays = {0};
    Upload on_device;
    bool ok = prepare(&session, scene, settings, &on_device, report, error) &&
              cast_arrays(&arrays, &session, rays, count, error) &&
              cast_session(&session, scene, &on_device, &arrays, count, report, error);
    for (long i = 0; ok && i < count; i++) {
        double t = session.wide_is_double ? ((double *)arrays.t)[i] : (double)((float *)arrays.t)[i];
        hits[i] = (CastHit){arrays.faces[i], t};
    }
    free(arrays.rays);
    free(arrays.faces);
    free(arrays.t);
    opencl_close(&session);
    return ok;
}
