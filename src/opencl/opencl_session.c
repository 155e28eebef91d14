/* A device made ready: context, queue and buffers. Every OpenCL call goes through opencl_ok. */
#include "opencl/opencl_session.h"

#include "base/clock.h"
#include "opencl/opencl_status.h"

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

bool opencl_has_pairs(const OpenclSession *session)
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
    session->casts_pairs = session->casts && opencl_has_pairs(session) && settings->lanes == 0;
    if (session->kernel != KERNEL_PACKET || session->casts_pairs)
        session->lanes = 1;
    session->packet_columns = session->lanes == 16 ? 4 : session->lanes >= 4 ? session->lanes / 2 : 1;
    session->packets_across = session->lanes > 1 ? 2 : 1;
    session->block_across = session->lanes > 1 ? 4 : 1;
    session->block_columns = session->packet_columns * session->packets_across * session->block_across;
    session->block_rows = session->lanes / session->packet_columns * session->packets_across * session->block_across;
    return true;
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
