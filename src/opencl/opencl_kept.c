/* Programs kept from one run to the next, as the device's binaries. */
#include "opencl/opencl_kept.h"

#include "opencl/pocl_binary.h"

#include <stdlib.h>

KernelCacheKey opencl_kept_key(const DeviceInfo *info, const char *root, const char *sources, const char *options)
{
    const char *place[] = {info->platform, info->name, info->version, info->driver, root, options};
    KernelCacheKey key = {KERNEL_CACHE_HASH_START, KERNEL_CACHE_HASH_START};
    for (size_t i = 0; i < sizeof place / sizeof place[0]; i++)
        key.place = kernel_cache_hash(key.place, place[i]);
    key.sources = kernel_cache_hash(key.sources, sources);
    return key;
}

/* NULL if the device does not take the binary. */
static cl_program build_binary(cl_context context, cl_device_id device, const unsigned char *binary, size_t size,
                               const char *options)
{
    cl_int taken = CL_SUCCESS, status;
    cl_program program = clCreateProgramWithBinary(context, 1, &device, &size, &binary, &taken, &status);
    if (status == CL_SUCCESS && taken == CL_SUCCESS)
        status = clBuildProgram(program, 1, &device, options, NULL, NULL);
    if (status == CL_SUCCESS && taken == CL_SUCCESS)
        return program;
    if (program)
        clReleaseProgram(program);
    return NULL;
}

/* The program without what PoCL would parse in vain; NULL where that is not known to work. */
static cl_program build_trimmed(cl_context context, cl_device_id device, const unsigned char *binary, size_t size,
                                const char *options)
{
    PoclBinary trimmed;
    if (!pocl_binary_trim(binary, size, &trimmed))
        return NULL;
    cl_program program = NULL;
    if (pocl_binary_unpack(&trimmed))
        program = build_binary(context, device, trimmed.bytes, trimmed.size, options);
    if (program && !pocl_binary_is_unpacked(&trimmed)) {
        clReleaseProgram(program);
        program = NULL;
    }
    free(trimmed.bytes);
    return program;
}

cl_program opencl_kept_program(const DeviceInfo *info, cl_context context, cl_device_id device, KernelCacheKey key,
                               const char *options)
{
    size_t size;
    unsigned char *binary = kernel_cache_load(key, &size);
    cl_program program = NULL;
    if (binary && pocl_binary_is_known(info->platform, info->driver))
        program = build_trimmed(context, device, binary, size, options);
    if (binary && !program)
        program = build_binary(context, device, binary, size, options);
    free(binary);
    return program;
}

void opencl_keep_program(cl_program program, KernelCacheKey key)
{
    size_t size = 0;
    if (clGetProgramInfo(program, CL_PROGRAM_BINARY_SIZES, sizeof size, &size, NULL) != CL_SUCCESS || size == 0)
        return;
    unsigned char *binary = malloc(size);
    if (binary && clGetProgramInfo(program, CL_PROGRAM_BINARIES, sizeof binary, &binary, NULL) == CL_SUCCESS)
        kernel_cache_store(key, binary, size);
    free(binary);
}
