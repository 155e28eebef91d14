/* The passes of a band: kernels/gpu.cl and gpu_exact.cl, or those that kernels/gpu_adaptive.cl lists. */
#include "opencl/opencl_gpu_passes.h"

#include "opencl/opencl_status.h"

#include <string.h>

enum {
    MOST_ITEMS = 1 << 20,       /* of a band: enough to fill a GPU, and its list of doubts takes 24 MiB */
    MOST_TRAIL_WORDS = 1 << 24, /* of a band: 64 MiB */
    EXACT_GROUPS_PER_UNIT = 8   /* groups of a pass that goes through a list */
};

/* Words of a pixel's trail: its length, max_bounces + 1 hits, and a miss in place of the last one. */
static size_t trail_words(const Parameters *parameters)
{
    return TRAIL_FACES + (size_t)parameters->max_bounces + 1;
}

size_t gpu_passes_most(const OpenclSession *session, const Parameters *parameters)
{
    size_t by_trails = MOST_TRAIL_WORDS / trail_words(parameters);
    return session->adaptive && by_trails < MOST_ITEMS ? by_trails : MOST_ITEMS;
}

int gpu_passes_counts(const OpenclSession *session)
{
    return session->adaptive ? GPU_COUNTS : 1;
}

/* --- Making them --- */

static bool make_lists(GpuPasses *passes, OpenclSession *session, const Parameters *parameters, size_t pixels,
                       Error *error)
{
    for (int i = 0; i < gpu_passes_counts(session); i++)
        if (!(passes->counts[i] = opencl_buffer(session, CL_MEM_READ_WRITE, sizeof(cl_uint), NULL, error)))
            return false;
    /* All pixels of a band may be in doubt. */
    size_t doubts = pixels * DOUBT_WORDS * sizeof(cl_uint), trails = pixels * trail_words(parameters) * sizeof(cl_int);
    if (!(passes->doubts = opencl_buffer(session, CL_MEM_READ_WRITE, doubts, NULL, error)))
        return false;
    return !session->adaptive ||
           ((passes->refined = opencl_buffer(session, CL_MEM_READ_WRITE, pixels * sizeof(cl_uint), NULL, error)) &&
            (passes->trails = opencl_buffer(session, CL_MEM_READ_WRITE, trails, NULL, error)) &&
            (passes->refinement = opencl_buffer(session, CL_MEM_READ_ONLY, sizeof(Parameters), NULL, error)));
}

/* The lists that a pass takes after the scene; NULL ends them. */
typedef struct PassPlan {
    int program;
    const char *name;
    bool is_exact; /* it takes the planes */
    cl_mem parameters;
    cl_mem lists[4];
    GpuPass pass;
} PassPlan;

static bool add_pass(GpuPasses *passes, const OpenclSession *session, const SceneOnDevice *scene, const PassPlan *plan,
                     Error *error)
{
    cl_mem arguments[OPENCL_MAX_BUFFERS];
    int count = 0;
    arguments[count++] = plan->parameters;
    arguments[count++] = scene->faces;
    arguments[count++] = scene->face_rows;
    if (plan->is_exact)
        arguments[count++] = scene->planes;
    cl_mem rest[] = {scene->materials,   scene->lights,    scene->view,
                     scene->tree_floats, scene->tree_ints, scene->counters};
    for (size_t i = 0; i < sizeof rest / sizeof *rest; i++)
        arguments[count++] = rest[i];
    for (int i = 0; i < 4 && plan->lists[i]; i++)
        arguments[count++] = plan->lists[i];
    GpuPass *pass = &passes->pass[passes->count++];
    *pass = plan->pass;
    pass->buffers = (cl_uint)count;
    pass->kernel = opencl_kernel(&session->programs[plan->program], plan->name, arguments, count, error);
    return pass->kernel != NULL;
}

static bool make_uniform(GpuPasses *passes, const OpenclSession *session, const SceneOnDevice *scene, Error *error)
{
    cl_mem count = passes->counts[GPU_DOUBTS];
    const PassPlan plans[] = {
        {PROGRAM_MAIN,
         "render_float",
         false,
         scene->parameters,
         {count, passes->doubts},
         {.takes_picture = true, .takes_rows = true, .by_pixel = true, .in_groups = true}},
        {PROGRAM_EXACT, "render_doubts", true, scene->parameters, {count, passes->doubts}, {.takes_picture = true}},
    };
    return add_pass(passes, session, scene, &plans[0], error) && add_pass(passes, session, scene, &plans[1], error);
}

static bool make_adaptive(GpuPasses *passes, const OpenclSession *session, const SceneOnDevice *scene, Error *error)
{
    cl_mem *counts = passes->counts, doubts = passes->doubts, refined = passes->refined, trails = passes->trails;
    const PassPlan plans[] = {
        {PROGRAM_MAIN,
         "render_centres",
         false,
         scene->parameters,
         {counts[GPU_DOUBTS], doubts, trails},
         {.takes_picture = true, .takes_rows = true, .by_pixel = true, .in_groups = true}},
        {PROGRAM_EXACT,
         "render_centre_doubts",
         true,
         scene->parameters,
         {counts[GPU_DOUBTS], doubts, trails},
         {.takes_picture = true, .takes_rows = true}},
        {PROGRAM_JUDGE,
         "judge_centres",
         true,
         scene->parameters,
         {trails, counts[GPU_REFINED], refined},
         {.takes_rows = true, .by_pixel = true}},
        {PROGRAM_MAIN,
         "render_refined",
         false,
         passes->refinement,
         {counts[GPU_REFINED_DOUBTS], doubts, counts[GPU_REFINED], refined},
         {.takes_picture = true, .by_pixel = true, .in_groups = true}},
        {PROGRAM_EXACT,
         "render_doubts",
         true,
         passes->refinement,
         {counts[GPU_REFINED_DOUBTS], doubts},
         {.takes_picture = true}},
    };
    for (size_t i = 0; i < sizeof plans / sizeof *plans; i++)
        if (!add_pass(passes, session, scene, &plans[i], error))
            return false;
    return true;
}

bool gpu_passes_make(GpuPasses *passes, OpenclSession *session, const SceneOnDevice *on_device,
                     const Parameters *parameters, size_t pixels, Error *error)
{
    *passes = (GpuPasses){.count = 0};
    return make_lists(passes, session, parameters, pixels, error) &&
           (session->adaptive ? make_adaptive(passes, session, on_device, error)
                              : make_uniform(passes, session, on_device, error));
}

void gpu_passes_free(GpuPasses *passes)
{
    for (int i = 0; i < passes->count; i++)
        if (passes->pass[i].kernel)
            clReleaseKernel(passes->pass[i].kernel);
    *passes = (GpuPasses){.count = 0};
}

/* --- Launching them --- */

static bool write_without_waiting(OpenclSession *session, cl_mem buffer, const void *data, size_t bytes, Error *error)
{
    return opencl_ok(error, clEnqueueWriteBuffer(session->queue, buffer, CL_FALSE, 0, bytes, data, 0, NULL, NULL),
                     "clEnqueueWriteBuffer");
}

bool gpu_passes_begin(const GpuPasses *passes, OpenclSession *session, const SceneOnDevice *on_device,
                      const Parameters parameters[2], Error *error)
{
    size_t bytes = sizeof *parameters;
    return write_without_waiting(session, on_device->parameters, &parameters[0], bytes, error) &&
           (!passes->refinement || write_without_waiting(session, passes->refinement, &parameters[1], bytes, error));
}

static bool set_band(const GpuPass *pass, const Parameters *band, cl_mem picture, Error *error)
{
    cl_uint next = pass->buffers;
    cl_int first_row = band->first_row, rows = band->band_rows, status = CL_SUCCESS;
    if (pass->takes_picture)
        status = clSetKernelArg(pass->kernel, next++, sizeof picture, &picture);
    if (status == CL_SUCCESS)
        status = clSetKernelArg(pass->kernel, next++, sizeof first_row, &first_row);
    if (status == CL_SUCCESS && pass->takes_rows)
        status = clSetKernelArg(pass->kernel, next, sizeof rows, &rows);
    return opencl_ok(error, status, "clSetKernelArg");
}

static size_t round_up(int count, int step)
{
    return ((size_t)count + (size_t)step - 1) / (size_t)step * (size_t)step;
}

static bool launch(const GpuPass *pass, const OpenclSession *session, const Parameters *band, cl_event *done,
                   Error *error)
{
    bool is_cpu = strcmp(session->info.type, "CPU") == 0;
    size_t items = (size_t)session->info.compute_units * EXACT_GROUPS_PER_UNIT * GPU_GROUP_ITEMS;
    size_t group = is_cpu && !pass->in_groups ? 1 : GPU_GROUP_ITEMS;
    if (pass->by_pixel)
        items = round_up(band->band_columns, GPU_GROUP_ACROSS) *
                round_up(band->band_rows > 0 ? band->band_rows : 1, GPU_GROUP_ACROSS);
    return opencl_ok(error,
                     clEnqueueNDRangeKernel(session->queue, pass->kernel, 1, NULL, &items, &group, 0, NULL, done),
                     "clEnqueueNDRangeKernel");
}

bool gpu_passes_launch(const GpuPasses *passes, OpenclSession *session, const Parameters *band, cl_mem picture,
                       cl_event events[2], Error *error)
{
    static const cl_uint zero = 0;
    for (int i = 0; i < gpu_passes_counts(session); i++)
        if (!write_without_waiting(session, passes->counts[i], &zero, sizeof zero, error))
            return false;
    for (int i = 0; i < passes->count; i++) {
        const GpuPass *pass = &passes->pass[i];
        cl_event *event = i == 0 ? &events[0] : i == passes->count - 1 ? &events[1] : NULL;
        if (!set_band(pass, band, picture, error) || !launch(pass, session, band, event, error))
            return false;
    }
    return true;
}
