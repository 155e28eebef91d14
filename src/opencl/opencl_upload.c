/* A scene on a device, ready to be traced. */
#include "opencl/opencl_upload.h"

#include "base/clock.h"
#include "opencl/device_scene.h"
#include "opencl/device_tree.h"
#include "opencl/opencl_program.h"
#include "opencl/opencl_status.h"
#include "trace/accel.h"
#include "trace/skip.h"

#include <stdlib.h>

enum { COUNTERS = COUNTER_STRIPES * COUNTER_STRIDE };

Parameters opencl_parameters(const Scene *scene)
{
    return (Parameters){
        .columns = scene->screen.columns,
        .rows = scene->screen.rows,
        .band_columns = scene->screen.columns,
        .grid = scene->grid,
        .face_count = scene->face_count,
        .light_count = scene->light_count,
        .max_bounces = scene->shading.max_bounces,
        .shadow_ambient = scene->shading.shadow == SHADOW_AMBIENT,
        .viewer_ray = scene->shading.viewer == VIEWER_RAY,
    };
}

/* A buffer for reading that takes over `count` items; OpenCL has none of
 * zero bytes, so that nothing gets one item, of any value. */
static cl_mem buffer_of(OpenclSession *session, void *data, size_t count, size_t item, Error *error)
{
    if (count > 0)
        return opencl_take(session, data, count * item, error);
    free(data);
    return opencl_buffer(session, CL_MEM_READ_ONLY, item, NULL, error);
}

static cl_mem buffer_of_reals(OpenclSession *session, DeviceReals *reals, Error *error)
{
    void *data = reals->data;
    reals->data = NULL;
    return opencl_take(session, data, device_reals_bytes(reals), error);
}

static cl_mem buffer_of_faces(OpenclSession *session, DeviceScene *packed, size_t count, Error *error)
{
    FaceRecord *faces = packed->faces.records;
    packed->faces.records = NULL;
    return buffer_of(session, faces, count, sizeof *faces, error);
}

static cl_mem buffer_of_floats(OpenclSession *session, DeviceTree *tree, Error *error)
{
    float *floats = tree->floats;
    tree->floats = NULL;
    return buffer_of(session, floats, tree->float_count, sizeof *floats, error);
}

static cl_mem buffer_of_ints(OpenclSession *session, DeviceTree *tree, Error *error)
{
    int *ints = tree->ints;
    tree->ints = NULL;
    return buffer_of(session, ints, tree->int_count, sizeof *ints, error);
}

/* A scene on its way to a device, and what the host makes of it. */
typedef struct Preparation {
    const Scene *scene;
    const RenderSettings *settings;
    unsigned char *closed; /* by skip_closed_boxes */
    Accel accel;
    DeviceTree tree;
} Preparation;

unsigned char *opencl_closed_boxes(const Scene *scene, const RenderSettings *settings, Error *error)
{
    unsigned char *closed = calloc((size_t)scene->face_count + 1, 1);
    if (!closed)
        error_memory(error, "the boxes of the scene");
    else if (skip_wanted(settings, SKIP_BACK_FACE))
        skip_closed_boxes(scene, closed, settings->threads);
    return closed;
}

static bool build_tree(const OpenclSession *session, Preparation *made, RenderReport *report, Error *error)
{
    double start = clock_ms();
    const RenderSettings *settings = made->settings;
    DevicePlan plan = {made->closed, session->lanes > 4 ? session->lanes : 4, settings->threads};
    bool no_tree = settings->accel == ACCEL_AUTO && skip_wanted(settings, SKIP_TREE);
    AccelKind kind = settings->accel;
    if (kind == ACCEL_AUTO && session->single && accel_sorting_pays(made->scene, settings))
        kind = ACCEL_LBVH;
    else if (kind == ACCEL_AUTO && !no_tree)
        kind = ACCEL_BVH;
    bool ok = accel_build(&made->accel, made->scene, kind, settings->threads, error) &&
              device_tree_pack(&made->tree, &made->accel, &plan, error);
    free(made->accel.bvh.nodes); /* the device's tree has replaced them: of a large scene they are much memory */
    made->accel.bvh.nodes = NULL;
    report->skipped[SKIP_TREE] = ok && no_tree && made->accel.kind == ACCEL_NONE;
    report->build_ms = clock_ms() - start;
    return ok;
}

static uint64_t device_bytes(const Scene *scene, const DeviceScene *packed, const DeviceTree *tree)
{
    return (uint64_t)scene->face_count * sizeof(FaceRecord) + device_reals_bytes(&packed->faces.rows) +
           device_reals_bytes(&packed->faces.planes) + device_reals_bytes(&packed->materials) +
           device_reals_bytes(&packed->lights) + device_reals_bytes(&packed->view) + tree->float_count * sizeof(float) +
           tree->int_count * sizeof(int);
}

static bool upload(OpenclSession *session, Preparation *made, SceneOnDevice *on_device, RenderReport *report,
                   Error *error)
{
    double start = clock_ms();
    DeviceScene packed;
    DeviceTree *tree = &made->tree;
    size_t faces = (size_t)made->scene->face_count;
    DevicePacking how = {.order = made->accel.bvh.order,
                         .closed = made->closed,
                         .precision = session->precision,
                         .wide = session->wide_is_double ? PRECISION_DOUBLE : PRECISION_FLOAT,
                         .threads = made->settings->threads,
                         .spent = made->settings->spent};
    bool ok =
        device_scene_pack(&packed, made->scene, &how, error) &&
        (on_device->parameters = opencl_buffer(session, CL_MEM_READ_ONLY, sizeof(Parameters), NULL, error)) &&
        (on_device->faces = buffer_of_faces(session, &packed, faces, error)) &&
        (on_device->face_rows = buffer_of_reals(session, &packed.faces.rows, error)) &&
        (on_device->planes = buffer_of_reals(session, &packed.faces.planes, error)) &&
        (on_device->materials = buffer_of_reals(session, &packed.materials, error)) &&
        (on_device->lights = buffer_of_reals(session, &packed.lights, error)) &&
        (on_device->view = buffer_of_reals(session, &packed.view, error)) &&
        (on_device->counters = opencl_buffer(session, CL_MEM_READ_WRITE, COUNTERS * sizeof(cl_uint), NULL, error)) &&
        (on_device->tree_floats = buffer_of_floats(session, tree, error)) &&
        (on_device->tree_ints = buffer_of_ints(session, tree, error));
    report->device_bytes = device_bytes(made->scene, &packed, tree);
    device_scene_free(&packed);
    report->upload_ms += clock_ms() - start;
    return ok;
}

bool opencl_prepare(OpenclSession *session, const Scene *scene, const RenderSettings *settings,
                    SceneOnDevice *on_device, RenderReport *report, Error *error)
{
    Preparation made = {.scene = scene, .settings = settings, .accel = {.kind = ACCEL_NONE}};
    bool ok =
        (made.closed = opencl_closed_boxes(scene, settings, error)) &&
        (session->context || opencl_open(session, settings, report, error)) &&
        build_tree(session, &made, report, error) &&
        opencl_build(session, (Variant){made.accel.kind, made.tree.node_width, made.tree.stack_size}, report, error) &&
        upload(session, &made, on_device, report, error);
    report->accel = accel_name(&made.accel);
    accel_free(&made.accel);
    device_tree_free(&made.tree);
    if (made.closed)
        session->taken[session->taken_count++] = made.closed;
    on_device->closed = made.closed;
    return ok;
}

static bool write_launch(OpenclSession *session, const SceneOnDevice *on_device, const Parameters *parameters,
                         Error *error)
{
    static const cl_uint zeros[COUNTERS];
    return opencl_ok(error,
                     clEnqueueWriteBuffer(session->queue, on_device->parameters, CL_TRUE, 0, sizeof *parameters,
                                          parameters, 0, NULL, NULL),
                     "clEnqueueWriteBuffer") &&
           opencl_ok(error,
                     clEnqueueWriteBuffer(session->queue, on_device->counters, CL_TRUE, 0, sizeof zeros, zeros, 0, NULL,
                                          NULL),
                     "clEnqueueWriteBuffer");
}

bool opencl_read_rectangle(OpenclSession *session, cl_mem buffer, Rectangle r, void *data, RenderReport *report,
                           Error *error)
{
    double start = clock_ms();
    const size_t from[3] = {r.left, r.top, 0}, to[3] = {0, 0, 0}, size[3] = {r.bytes, r.rows, 1};
    cl_int status = clEnqueueReadBufferRect(session->queue, buffer, CL_TRUE, from, to, size, r.row_bytes, 0, r.bytes, 0,
                                            data, 0, NULL, NULL);
    report->readback_ms += clock_ms() - start;
    return opencl_ok(error, status, "clEnqueueReadBufferRect");
}

bool opencl_read(OpenclSession *session, cl_mem buffer, size_t bytes, void *data, RenderReport *report, Error *error)
{
    double start = clock_ms();
    cl_int status = clEnqueueReadBuffer(session->queue, buffer, CL_TRUE, 0, bytes, data, 0, NULL, NULL);
    report->readback_ms += clock_ms() - start;
    return opencl_ok(error, status, "clEnqueueReadBuffer");
}

void opencl_add_counters(const unsigned *counters, RenderReport *report)
{
    uint64_t sums[COUNTER_KINDS] = {0};
    for (int i = 0; i < COUNTERS; i++)
        if (i % COUNTER_STRIDE < COUNTER_KINDS)
            sums[i % COUNTER_STRIDE] += counters[i];
    report->rays.primary += sums[COUNT_PRIMARY];
    report->rays.shadow += sums[COUNT_SHADOW];
    report->rays.reflection += sums[COUNT_REFLECTION];
    for (int skip = 0; skip < SKIPS_COUNTED; skip++)
        report->skipped[skip] += sums[COUNT_SKIPPED + skip];
    report->face_tests += sums[COUNT_FACE_TESTS];
    report->box_tests += sums[COUNT_BOX_TESTS];
}

static bool add_counters(OpenclSession *session, const SceneOnDevice *on_device, RenderReport *report, Error *error)
{
    cl_uint counters[COUNTERS];
    if (!opencl_read(session, on_device->counters, sizeof counters, counters, report, error))
        return false;
    opencl_add_counters(counters, report);
    return true;
}

bool opencl_launch(OpenclSession *session, const SceneOnDevice *on_device, cl_kernel kernel,
                   const Parameters *parameters, size_t items, RenderReport *report, Error *error)
{
    if (!write_launch(session, on_device, parameters, error))
        return false;
    double start = clock_ms();
    bool ok = opencl_run(session, kernel, items, error);
    report->trace_ms += clock_ms() - start;
    return ok && add_counters(session, on_device, report, error);
}

bool opencl_warm_up(OpenclSession *session, const SceneOnDevice *on_device, cl_kernel kernel, Parameters parameters,
                    RenderReport *report, Error *error)
{
    double start = clock_ms();
    parameters.band_rows = 0;
    parameters.ray_count = 0;
    bool ok = write_launch(session, on_device, &parameters, error) && opencl_run(session, kernel, 1, error);
    if (ok)
        opencl_keep(session);
    report->compile_ms += clock_ms() - start;
    return ok;
}
