/* Programs kept from one run to the next, as the device's binaries. */
#ifndef RECTRAY_OPENCL_KEPT_H
#define RECTRAY_OPENCL_KEPT_H

#include "opencl/kernel_cache.h"
#include "opencl/opencl_device.h"

/* root: the kernel file that includes all others. */
KernelCacheKey opencl_kept_key(const DeviceInfo *info, const char *root, const char *sources, const char *options);

/* The kept program, built; NULL if there is none, or the device does not take it any more. */
cl_program opencl_kept_program(const DeviceInfo *info, cl_context context, cl_device_id device, KernelCacheKey key,
                               const char *options);

/* Keeps a program whose kernel has run once. */
void opencl_keep_program(cl_program program, KernelCacheKey key);

#endif
