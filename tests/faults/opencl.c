/* An OpenCL that fails, for LD_PRELOAD: stands before the loader, counts the calls, lets some of them fail, and tells
 * what was not released. From the environment:
 *   FAULT_AT=N       the N-th call fails, from 1; without it none
 *   FAULT_ON=1       and every one after it
 *   FAULT_DEVICES=0  every platform says that it has no device
 *   FAULT_LOG=FILE   gets one line in the end: "CALLS LEFT [NAME]", LEFT being how many objects nobody released, NAME
 *                    the first call that failed
 * Releases never fail: nothing can be done about one that does. Nor does clGetEventProfilingInfo: without it a time is
 * told as 0, and the picture is whole. To add a call that the program makes, add its line. */
#define _GNU_SOURCE
#define CL_TARGET_OPENCL_VERSION 120
#include <CL/cl.h>
#include <dlfcn.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>

static long calls, left;
static const char *first_failed = "";

__attribute__((destructor)) static void tell(void)
{
    const char *log = getenv("FAULT_LOG");
    FILE *file = log ? fopen(log, "w") : NULL;
    if (file) {
        fprintf(file, "%ld %ld %s\n", calls, left, first_failed);
        fclose(file);
    }
}

static long number_of(const char *name)
{
    const char *text = getenv(name);
    return text ? atol(text) : 0;
}

static bool fails(const char *name)
{
    long at = number_of("FAULT_AT");
    calls++;
    if (at == 0 || (number_of("FAULT_ON") ? calls < at : calls != at))
        return false;
    if (!first_failed[0])
        first_failed = name;
    return true;
}

static cl_int failed(cl_int *status)
{
    if (status)
        *status = CL_OUT_OF_RESOURCES;
    return CL_OUT_OF_RESOURCES;
}

/* The loader's function of the same name; ISO C has no cast from an object to a function. */
#define REAL(name)          \
    __typeof__(&name) real; \
    *(void **)&real = dlsym(RTLD_NEXT, #name)

/* A call that returns its status. */
#define STATUS_CALL(name, parameters, arguments)             \
    cl_int name parameters                                   \
    {                                                        \
        REAL(name);                                          \
        return fails(#name) ? failed(NULL) : real arguments; \
    }

/* One that returns its status and hands out an event if it is asked for one. */
#define EVENT_CALL(name, parameters, arguments)          \
    cl_int name parameters                               \
    {                                                    \
        REAL(name);                                      \
        if (fails(#name))                                \
            return failed(NULL);                         \
        cl_int status = real arguments;                  \
        left += status == CL_SUCCESS && event && *event; \
        return status;                                   \
    }

/* One that returns an object, and its status through the last parameter. */
#define OBJECT_CALL(type, name, parameters, arguments) \
    type name parameters                               \
    {                                                  \
        REAL(name);                                    \
        if (fails(#name)) {                            \
            failed(status);                            \
            return NULL;                               \
        }                                              \
        type object = real arguments;                  \
        left += object != NULL;                        \
        return object;                                 \
    }

#define RELEASE_CALL(name, type) \
    cl_int name(type object)     \
    {                            \
        REAL(name);              \
        calls++;                 \
        left--;                  \
        return real(object);     \
    }

STATUS_CALL(clGetPlatformIDs, (cl_uint room, cl_platform_id *platforms, cl_uint *count), (room, platforms, count))
STATUS_CALL(clGetPlatformInfo, (cl_platform_id id, cl_platform_info key, size_t size, void *value, size_t *needed),
            (id, key, size, value, needed))
STATUS_CALL(clGetDeviceInfo, (cl_device_id id, cl_device_info key, size_t size, void *value, size_t *needed),
            (id, key, size, value, needed))

cl_int clGetDeviceIDs(cl_platform_id platform, cl_device_type type, cl_uint room, cl_device_id *devices, cl_uint *count)
{
    REAL(clGetDeviceIDs);
    if (getenv("FAULT_DEVICES"))
        return CL_DEVICE_NOT_FOUND;
    return fails("clGetDeviceIDs") ? failed(NULL) : real(platform, type, room, devices, count);
}

OBJECT_CALL(cl_context, clCreateContext,
            (const cl_context_properties *properties, cl_uint count, const cl_device_id *devices,
             void(CL_CALLBACK *notify)(const char *, const void *, size_t, void *), void *user, cl_int *status),
            (properties, count, devices, notify, user, status))
OBJECT_CALL(cl_command_queue, clCreateCommandQueue,
            (cl_context context, cl_device_id device, cl_command_queue_properties properties, cl_int *status),
            (context, device, properties, status))
OBJECT_CALL(cl_mem, clCreateBuffer, (cl_context context, cl_mem_flags flags, size_t size, void *data, cl_int *status),
            (context, flags, size, data, status))
OBJECT_CALL(cl_program, clCreateProgramWithSource,
            (cl_context context, cl_uint count, const char **texts, const size_t *lengths, cl_int *status),
            (context, count, texts, lengths, status))
OBJECT_CALL(cl_program, clCreateProgramWithBinary,
            (cl_context context, cl_uint count, const cl_device_id *devices, const size_t *lengths,
             const unsigned char **binaries, cl_int *taken, cl_int *status),
            (context, count, devices, lengths, binaries, taken, status))
OBJECT_CALL(cl_kernel, clCreateKernel, (cl_program program, const char *name, cl_int *status), (program, name, status))

STATUS_CALL(clBuildProgram,
            (cl_program program, cl_uint count, const cl_device_id *devices, const char *options,
             void(CL_CALLBACK *notify)(cl_program, void *), void *user),
            (program, count, devices, options, notify, user))
STATUS_CALL(clGetProgramInfo, (cl_program program, cl_program_info key, size_t size, void *value, size_t *needed),
            (program, key, size, value, needed))
STATUS_CALL(clGetProgramBuildInfo,
            (cl_program program, cl_device_id device, cl_program_build_info key, size_t size, void *value,
             size_t *needed),
            (program, device, key, size, value, needed))
STATUS_CALL(clSetKernelArg, (cl_kernel kernel, cl_uint index, size_t size, const void *value),
            (kernel, index, size, value))
EVENT_CALL(clEnqueueWriteBuffer,
           (cl_command_queue queue, cl_mem buffer, cl_bool wait, size_t offset, size_t size, const void *data,
            cl_uint count, const cl_event *events, cl_event *event),
           (queue, buffer, wait, offset, size, data, count, events, event))
EVENT_CALL(clEnqueueReadBuffer,
           (cl_command_queue queue, cl_mem buffer, cl_bool wait, size_t offset, size_t size, void *data, cl_uint count,
            const cl_event *events, cl_event *event),
           (queue, buffer, wait, offset, size, data, count, events, event))
EVENT_CALL(clEnqueueReadBufferRect,
           (cl_command_queue queue, cl_mem buffer, cl_bool wait, const size_t *from, const size_t *to,
            const size_t *size, size_t from_row, size_t from_slice, size_t to_row, size_t to_slice, void *data,
            cl_uint count, const cl_event *events, cl_event *event),
           (queue, buffer, wait, from, to, size, from_row, from_slice, to_row, to_slice, data, count, events, event))
EVENT_CALL(clEnqueueNDRangeKernel,
           (cl_command_queue queue, cl_kernel kernel, cl_uint dimensions, const size_t *offset, const size_t *global,
            const size_t *local, cl_uint count, const cl_event *events, cl_event *event),
           (queue, kernel, dimensions, offset, global, local, count, events, event))
STATUS_CALL(clFinish, (cl_command_queue queue), (queue))
STATUS_CALL(clFlush, (cl_command_queue queue), (queue))
STATUS_CALL(clWaitForEvents, (cl_uint count, const cl_event *events), (count, events))

RELEASE_CALL(clReleaseEvent, cl_event)
RELEASE_CALL(clReleaseMemObject, cl_mem)
RELEASE_CALL(clReleaseKernel, cl_kernel)
RELEASE_CALL(clReleaseProgram, cl_program)
RELEASE_CALL(clReleaseCommandQueue, cl_command_queue)
RELEASE_CALL(clReleaseContext, cl_context)
