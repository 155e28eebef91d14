/* A device made ready: context, queue and compiled kernels. Every OpenCL call goes through opencl_ok. */
#include "opencl/opencl_program.h"

#include "base/clock.h"
#include "opencl/opencl_kept.h"
#include "opencl/opencl_sources.h"
#include "opencl/opencl_status.h"

#include "kernels/shared/layout.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* The kernels are OpenCL C 1.2. A device that does not tell its version is tried. */
static bool check_language(const DeviceInfo *info, Error *error)
{
    int major, minor;
    if (sscanf(info->c_version, "OpenCL C %d.%d", &major, &minor) != 2 || 10 * major + minor >= 12)
        return true;
    return error_set(error, ERROR_SYSTEM,
                     "the device %s knows %s only, and the kernels need OpenCL C 1.2; choose another device (see "
                     "`rectray devices`), or use --backend reference",
                     info->name, info->c_version);
}

/* The kernel for GPUs is float's, and has exact arithmetic only. Without double it is right where packets are not: its
 * exact pass computes in pairs of floats. */
static KernelKind kernel_for(const OpenclSession *session, const RenderSettings *settings)
{
    if (settings->kernel != KERNEL_AUTO)
        return settings->kernel;
    bool is_gpu = strcmp(session->info.type, "CPU") != 0 && session->info.lanes_float == 1;
    bool suits = (is_gpu || !session->info.has_double) && settings->lanes == 0 &&
                 settings->precision == PRECISION_FLOAT && !session->casts;
    return suits ? KERNEL_GPU : KERNEL_PACKET;
}

/* Does exact arithmetic of one ray compute in pairs of floats? Textbook arithmetic knows one precision. */
static bool has_pairs(const OpenclSession *session)
{
    return !session->info.has_double && session->arithmetic == ARITHMETIC_EXACT;
}

static bool choose_lanes(OpenclSession *session, const RenderSettings *settings, Error *error)
{
    bool is_double = settings->precision == PRECISION_DOUBLE;
    if (is_double && !session->info.has_double)
        return error_set(error, ERROR_SYSTEM, "the device %s has no double precision; use --precision float",
                         session->info.name);
    session->precision = settings->precision;
    session->kernel = kernel_for(session, settings);
    session->arithmetic = settings->arithmetic;
    /* The taught formulas know one precision. */
    session->wide_is_double = settings->arithmetic == ARITHMETIC_TEXTBOOK ? is_double : session->info.has_double;
    session->lanes = is_double ? session->info.lanes_double : session->info.lanes_float;
    if (settings->lanes > 0)
        session->lanes = settings->lanes;
    session->casts_pairs = session->casts && has_pairs(session) && settings->lanes == 0;
    if (session->kernel != KERNEL_PACKET || session->casts_pairs)
        session->lanes = 1;
    session->packet_columns = session->lanes == 16 ? 4 : session->lanes >= 4 ? session->lanes / 2 : 1;
    session->packets_across = session->lanes > 1 ? 2 : 1;
    session->block_across = session->lanes > 1 ? 4 : 1;
    session->block_columns = session->packet_columns * session->packets_across * session->block_across;
    session->block_rows = session->lanes / session->packet_columns * session->packets_across * session->block_across;
    return true;
}

/* The end of the compiler's log is cut where the message is full; its first errors matter most. */
static bool report_build_failure(const OpenclSession *session, cl_program program, cl_int status, Error *error)
{
    size_t size = 0;
    clGetProgramBuildInfo(program, session->device, CL_PROGRAM_BUILD_LOG, 0, NULL, &size);
    char *log = calloc(size + 1, 1);
    if (!log)
        return error_memory(error, "the compiler's log");
    clGetProgramBuildInfo(program, session->device, CL_PROGRAM_BUILD_LOG, size, log, NULL);
    error_set(error, ERROR_SYSTEM, "the kernels do not compile for %s (%s); the compiler says:\n%s", session->info.name,
              opencl_status_name(status), log);
    free(log);
    return false;
}

/* wide_is_double: as the program has it. */
static void write_options(const OpenclSession *session, Variant variant, bool wide_is_double, char *options,
                          size_t room)
{
    int accel = variant.accel == ACCEL_BVH ? 1 : variant.accel == ACCEL_KDTREE ? 2 : 0;
    snprintf(options, room,
             "-DLANES=%d -DREAL_DOUBLE=%d -DHAS_DOUBLE=%d -DPACKETS=%d -DPACKETS_ACROSS=%d "
             "-DPACKET_COLUMNS=%d -DPACKET_ROWS=%d -DACCEL=%d -DNODE_WIDTH=%d "
             "-DBLOCK_ACROSS=%d -DSTACK_SIZE=%d -DFACE_RECORD_BYTES=%d -DPARAMETERS_BYTES=%d",
             session->lanes, session->precision == PRECISION_DOUBLE, wide_is_double,
             session->packets_across * session->packets_across, session->packets_across, session->packet_columns,
             session->lanes / session->packet_columns, accel, variant.node_width, session->block_across,
             variant.stack_size, (int)sizeof(FaceRecord), (int)sizeof(Parameters));
    size_t used = strlen(options);
    /* NVIDIA's compiler would take more of the 65 536 registers that all work-items share: docs/gpu.md, section 6. */
    bool few_registers = session->kernel == KERNEL_GPU && strstr(session->info.platform, "NVIDIA");
    snprintf(options + used, room - used, "%s%s", session->linear ? " -DLINEAR=1" : "",
             few_registers ? " -cl-nv-maxrregcount=128" : "");
}

/* How many programs a session has. */
static int program_count(const OpenclSession *session)
{
    return session->kernel != KERNEL_GPU ? 1 : session->adaptive ? OPENCL_PROGRAMS : PROGRAM_EXACT + 1;
}

/* The kernel file that includes all that the session needs. Tiles of several packets are classified where float has
 * double for its exact rays. */
static const char *root_of(const OpenclSession *session, int program)
{
    static const char *const uniform[] = {[PROGRAM_MAIN] = "gpu.cl", [PROGRAM_EXACT] = "gpu_exact.cl"};
    static const char *const adaptive[] = {[PROGRAM_MAIN] = "gpu_adaptive.cl",
                                           [PROGRAM_EXACT] = "gpu_adaptive_exact.cl",
                                           [PROGRAM_JUDGE] = "gpu_judge.cl"};
    if (session->casts)
        return session->casts_pairs ? "pairs/cast.cl" : "packet/cast.cl";
    if (session->kernel == KERNEL_PLAIN)
        return has_pairs(session) ? "pairs.cl" : "plain.cl";
    if (session->kernel == KERNEL_GPU)
        return session->adaptive ? adaptive[program] : uniform[program];
    if (session->adaptive)
        return "adaptive/refine.cl";
    bool classifies = session->precision == PRECISION_FLOAT && session->wide_is_double && session->packets_across > 1;
    return classifies ? "tile/render.cl" : "packet/render.cl";
}

static void notify_compiling(const OpenclSession *session)
{
    char text[256];
    snprintf(text, sizeof text, "compiling the kernels for %s, once", session->info.name);
    if (session->notice.show)
        session->notice.show(session->notice.user, text);
}

static bool build_program(OpenclSession *session, OpenclProgram *made, const char *sources, const char *options,
                          Error *error)
{
    made->program = opencl_kept_program(&session->info, session->context, session->device, made->key, options);
    if (made->program)
        return true;
    made->from_source = true;
    notify_compiling(session);
    cl_int status;
    made->program = clCreateProgramWithSource(session->context, 1, &sources, NULL, &status);
    if (!opencl_ok(error, status, "clCreateProgramWithSource"))
        return false;
    status = clBuildProgram(made->program, 1, &session->device, options, NULL, NULL);
    return status == CL_SUCCESS || report_build_failure(session, made->program, status, error);
}

void opencl_keep(OpenclSession *session)
{
    for (int i = 0; i < OPENCL_PROGRAMS; i++) {
        if (session->programs[i].from_source)
            opencl_keep_program(session->programs[i].program, session->programs[i].key);
        session->programs[i].from_source = false;
    }
}

static bool open_context(OpenclSession *session, Error *error)
{
    cl_int status;
    session->context = clCreateContext(NULL, 1, &session->device, NULL, NULL, &status);
    if (!opencl_ok(error, status, "clCreateContext"))
        return false;
    /* The kernel for GPUs is timed by the device, while the host does other work. */
    cl_command_queue_properties timed = session->kernel == KERNEL_GPU ? CL_QUEUE_PROFILING_ENABLE : 0;
    session->queue = clCreateCommandQueue(session->context, session->device, timed, &status);
    return opencl_ok(error, status, "clCreateCommandQueue");
}

bool opencl_open(OpenclSession *session, const RenderSettings *settings, RenderReport *report, Error *error)
{
    double start = clock_ms();
    session->notice = settings->notice;
    session->no_skip = settings->no_skip;
    session->shift = settings->shift;
    if (!opencl_find_device(settings->device, settings->threads, &session->device, &session->info, error) ||
        !check_language(&session->info, error) || !choose_lanes(session, settings, error) ||
        !open_context(session, error))
        return false;
    report->lanes = session->lanes;
    report->kernel = session->kernel;
    report->threads = session->info.compute_units;
    snprintf(report->device, sizeof report->device, "%s", session->info.name);
    report->device_ms = clock_ms() - start;
    return true;
}

static const char *tree_of(AccelKind accel)
{
    return accel == ACCEL_BVH ? "bvh" : accel == ACCEL_KDTREE ? "kdtree" : "all_faces";
}

/* A program that was built with the same options stays. */
static bool make_program(OpenclSession *session, int which, Variant variant, RenderReport *report, Error *error)
{
    OpenclProgram *made = &session->programs[which];
    const char *root = root_of(session, which);
    char options[sizeof made->built];
    /* The kernels for GPUs know no double; their exact passes and what judges pixels do. */
    bool wide_is_double = session->wide_is_double && (session->kernel != KERNEL_GPU || which != PROGRAM_MAIN);
    write_options(session, variant, wide_is_double, options, sizeof options);
    if (which == PROGRAM_MAIN)
        memcpy(report->build_options, options, sizeof options);
    if (made->program && strcmp(made->built, options) == 0)
        return true;
    if (made->program)
        clReleaseProgram(made->program);
    *made = (OpenclProgram){0};
    const char *arithmetic = has_pairs(session) ? OPENCL_PAIRS : render_arithmetics[session->arithmetic];
    char *sources = opencl_sources(root, tree_of(variant.accel), arithmetic, error);
    if (!sources)
        return false;
    made->key = opencl_kept_key(&session->info, root, sources, options);
    bool ok = build_program(session, made, sources, options, error);
    if (ok)
        memcpy(made->built, options, sizeof options);
    free(sources);
    return ok;
}

bool opencl_build(OpenclSession *session, Variant variant, RenderReport *report, Error *error)
{
    double start = clock_ms();
    bool ok = true;
    for (int i = 0; i < program_count(session) && ok; i++)
        ok = make_program(session, i, variant, report, error);
    report->compile_ms = clock_ms() - start;
    return ok;
}

/* The host's memory is freed when no buffer is left that may stand on it. */
void opencl_drop(OpenclSession *session)
{
    for (int i = 0; i < session->buffer_count; i++)
        clReleaseMemObject(session->buffers[i]);
    for (int i = 0; i < session->taken_count; i++)
        free(session->taken[i]);
    session->buffer_count = session->taken_count = 0;
}

void opencl_close(OpenclSession *session)
{
    for (int i = 0; i < session->buffer_count; i++)
        clReleaseMemObject(session->buffers[i]);
    for (int i = 0; i < OPENCL_PROGRAMS; i++)
        if (session->programs[i].program)
            clReleaseProgram(session->programs[i].program);
    if (session->queue)
        clReleaseCommandQueue(session->queue);
    if (session->context)
        clReleaseContext(session->context);
    for (int i = 0; i < session->taken_count; i++)
        free(session->taken[i]);
    *session = (OpenclSession){0};
}

/* One that is freed with the session. */
static cl_mem make_buffer(OpenclSession *session, cl_mem_flags flags, size_t bytes, void *data, Error *error)
{
    cl_int status;
    cl_mem buffer = clCreateBuffer(session->context, flags, bytes, data, &status);
    if (!opencl_ok(error, status, "clCreateBuffer"))
        return NULL;
    session->buffers[session->buffer_count++] = buffer;
    return buffer;
}

cl_mem opencl_buffer(OpenclSession *session, cl_mem_flags flags, size_t bytes, const void *data, Error *error)
{
    if (data)
        flags |= CL_MEM_COPY_HOST_PTR;
    return make_buffer(session, flags, bytes, (void *)(size_t)data, error);
}

/* Less than this is copied: it costs nothing, and Oclgrind takes memory that it has not copied for unwritten. */
enum { TAKEN_BYTES = 1 << 20 };

cl_mem opencl_take(OpenclSession *session, void *data, size_t bytes, Error *error)
{
    if (strcmp(session->info.type, "CPU") == 0 && bytes >= TAKEN_BYTES) {
        session->taken[session->taken_count++] = data;
        return make_buffer(session, CL_MEM_READ_ONLY | CL_MEM_USE_HOST_PTR, bytes, data, error);
    }
    cl_mem buffer = opencl_buffer(session, CL_MEM_READ_ONLY, bytes, data, error);
    free(data);
    return buffer;
}

cl_kernel opencl_kernel(const OpenclProgram *program, const char *name, const cl_mem *arguments, int count,
                        Error *error)
{
    cl_int status;
    cl_kernel kernel = clCreateKernel(program->program, name, &status);
    if (!opencl_ok(error, status, "clCreateKernel"))
        return NULL;
    for (int i = 0; i < count && status == CL_SUCCESS; i++)
        status = clSetKernelArg(kernel, (cl_uint)i, sizeof arguments[i], &arguments[i]);
    if (opencl_ok(error, status, "clSetKernelArg"))
        return kernel;
    clReleaseKernel(kernel);
    return NULL;
}

bool opencl_run(OpenclSession *session, cl_kernel kernel, size_t items, Error *error)
{
    /* One work-item is a whole register of rays on a CPU; on a GPU the items of a group share a unit. */
    size_t local = session->lanes > 1 || strcmp(session->info.type, "CPU") == 0 ? 1 : 64;
    size_t global = (items + local - 1) / local * local;
    return opencl_ok(error, clEnqueueNDRangeKernel(session->queue, kernel, 1, NULL, &global, &local, 0, NULL, NULL),
                     "clEnqueueNDRangeKernel") &&
           opencl_ok(error, clFinish(session->queue), "clFinish");
}
