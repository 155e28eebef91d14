/* A device that poses as another, for LD_PRELOAD: stands before the loader and changes what the device says of itself,
 * so that the paths for other devices run on any machine. From the environment:
 *   SHIM_NO_DOUBLE=1       it has no double: CL_DEVICE_DOUBLE_FP_CONFIG is 0, no extension cl_khr_fp64
 *   SHIM_GPU=1             it is a GPU: no CPU, registers of one number
 *   SHIM_C_VERSION=TEXT    that is the language it knows
 *   SHIM_PLATFORM=TEXT     that is its platform's name
 *   SHIM_COMPILER=spirv    its compiler is none of a processor, and refuses __builtin_prefetch although it has it
 *   SHIM_COMPILER=bare     the same, and it has no __has_builtin
 *   SHIM_BUILD=refused     a program that was built counts as one that was not: what it takes to read the log
 *   SHIM_LOG=FILE          gets a line for each program that is built, "BUILT OPTIONS", and for each line of the
 *                          compiler's log "LOG ..."; and for each launch "LAUNCH ITEMS GROUP"
 *   SHIM_SPEED=N           it is N times as fast as it is, by the times that it tells of commands
 *   SHIM_SOURCES=FOLDER    gets the text of each program, 0.cl and so on, with the options that it is built with
 *                          as its first line
 * To change another property, add its case to clGetDeviceInfo. */
#define _GNU_SOURCE
#define CL_TARGET_OPENCL_VERSION 120
#include <CL/cl.h>
#include <dlfcn.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* The loader's function of the same name; ISO C has no cast from an object to a function. */
#define REAL(name)          \
    __typeof__(&name) real; \
    *(void **)&real = dlsym(RTLD_NEXT, #name)

static cl_int answer(const void *value, size_t length, size_t size, void *place, size_t *needed)
{
    if (needed)
        *needed = length;
    if (place && size < length)
        return CL_INVALID_VALUE;
    if (place)
        memcpy(place, value, length);
    return CL_SUCCESS;
}

static cl_int answer_text(const char *text, size_t size, void *place, size_t *needed)
{
    return answer(text, strlen(text) + 1, size, place, needed);
}

/* The device's extensions without double. */
static cl_int extensions_without_double(cl_device_id id, size_t size, void *place, size_t *needed)
{
    REAL(clGetDeviceInfo);
    static const char hidden[] = "cl_khr_fp64";
    char text[4096] = "";
    cl_int status = real(id, CL_DEVICE_EXTENSIONS, sizeof text, text, NULL);
    if (status != CL_SUCCESS)
        return status;
    for (char *at; (at = strstr(text, hidden));)
        memmove(at, at + sizeof hidden - 1, strlen(at + sizeof hidden - 1) + 1);
    return answer_text(text, size, place, needed);
}

cl_int clGetDeviceInfo(cl_device_id id, cl_device_info key, size_t size, void *value, size_t *needed)
{
    REAL(clGetDeviceInfo);
    const cl_device_type gpu = CL_DEVICE_TYPE_GPU;
    const cl_device_fp_config nothing = 0;
    const cl_uint zero = 0, one = 1;
    bool no_double = getenv("SHIM_NO_DOUBLE"), is_gpu = getenv("SHIM_GPU");
    const char *version = getenv("SHIM_C_VERSION");
    if (key == CL_DEVICE_DOUBLE_FP_CONFIG && no_double)
        return answer(&nothing, sizeof nothing, size, value, needed);
    if ((key == CL_DEVICE_NATIVE_VECTOR_WIDTH_DOUBLE || key == CL_DEVICE_PREFERRED_VECTOR_WIDTH_DOUBLE) && no_double)
        return answer(&zero, sizeof zero, size, value, needed);
    if (key == CL_DEVICE_EXTENSIONS && no_double)
        return extensions_without_double(id, size, value, needed);
    if (key == CL_DEVICE_TYPE && is_gpu)
        return answer(&gpu, sizeof gpu, size, value, needed);
    if ((key == CL_DEVICE_NATIVE_VECTOR_WIDTH_FLOAT || key == CL_DEVICE_NATIVE_VECTOR_WIDTH_DOUBLE) && is_gpu)
        return answer(&one, sizeof one, size, value, needed);
    if (key == CL_DEVICE_OPENCL_C_VERSION && version)
        return answer_text(version, size, value, needed);
    return real(id, key, size, value, needed);
}

cl_int clGetPlatformInfo(cl_platform_id id, cl_platform_info key, size_t size, void *value, size_t *needed)
{
    REAL(clGetPlatformInfo);
    const char *name = getenv("SHIM_PLATFORM");
    return key == CL_PLATFORM_NAME && name ? answer_text(name, size, value, needed)
                                           : real(id, key, size, value, needed);
}

/* Refusing a builtin is calling a function that there is not. */
static const char spirv[] = "#undef __x86_64__\n"
                            "#undef __aarch64__\n"
                            "#define __builtin_prefetch(place) prefetch_is_refused_here(place)\n";
static const char bare[] = "#undef __has_builtin\n";

static char *last_source;
static int source_count;

static void keep_source(const char *text)
{
    free(last_source);
    last_source = strdup(text);
}

static void write_source(const char *options)
{
    const char *folder = getenv("SHIM_SOURCES");
    if (!folder || !last_source)
        return;
    char name[4096];
    snprintf(name, sizeof name, "%s/%d.cl", folder, source_count++);
    FILE *file = fopen(name, "w");
    if (file) {
        fprintf(file, "// %s\n%s", options ? options : "", last_source);
        fclose(file);
    }
    free(last_source);
    last_source = NULL;
}

cl_program clCreateProgramWithSource(cl_context context, cl_uint count, const char **texts, const size_t *lengths,
                                     cl_int *status)
{
    REAL(clCreateProgramWithSource);
    const char *compiler = getenv("SHIM_COMPILER");
    if (count == 1 && !lengths)
        keep_source(texts[0]);
    if (!compiler || count != 1 || lengths)
        return real(context, count, texts, lengths, status);
    const char *all[] = {spirv, strcmp(compiler, "bare") == 0 ? bare : "", texts[0]};
    return real(context, 3, all, NULL, status);
}

static FILE *open_log(void)
{
    const char *name = getenv("SHIM_LOG");
    return name ? fopen(name, "a") : NULL;
}

static void log_build(cl_program program, cl_device_id device, const char *options)
{
    static char text[1 << 16];
    FILE *file = open_log();
    if (!file)
        return;
    fprintf(file, "BUILT %s\n", options ? options : "");
    if (clGetProgramBuildInfo(program, device, CL_PROGRAM_BUILD_LOG, sizeof text - 1, text, NULL) == CL_SUCCESS)
        for (char *line = strtok(text, "\n"); line; line = strtok(NULL, "\n"))
            fprintf(file, "LOG %s\n", line);
    fclose(file);
}

cl_int clBuildProgram(cl_program program, cl_uint count, const cl_device_id *devices, const char *options,
                      void(CL_CALLBACK *notify)(cl_program, void *), void *user)
{
    REAL(clBuildProgram);
    cl_int status = real(program, count, devices, options, notify, user);
    write_source(options);
    log_build(program, devices[0], options);
    return getenv("SHIM_BUILD") ? CL_BUILD_PROGRAM_FAILURE : status;
}

cl_int clEnqueueNDRangeKernel(cl_command_queue queue, cl_kernel kernel, cl_uint dimensions, const size_t *offset,
                              const size_t *items, const size_t *group, cl_uint count, const cl_event *wait,
                              cl_event *event)
{
    REAL(clEnqueueNDRangeKernel);
    FILE *file = open_log();
    if (file) {
        fprintf(file, "LAUNCH %zu %zu\n", items[0], group ? group[0] : 0);
        fclose(file);
    }
    return real(queue, kernel, dimensions, offset, items, group, count, wait, event);
}

cl_int clGetEventProfilingInfo(cl_event event, cl_profiling_info key, size_t size, void *value, size_t *needed)
{
    REAL(clGetEventProfilingInfo);
    const char *speed = getenv("SHIM_SPEED");
    cl_ulong time = 0;
    if (!speed)
        return real(event, key, size, value, needed);
    cl_int status = real(event, key, sizeof time, &time, NULL);
    time /= strtoul(speed, NULL, 10);
    return status == CL_SUCCESS ? answer(&time, sizeof time, size, value, needed) : status;
}
