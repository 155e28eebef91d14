/* Devices: all that OpenCL offers, in the loader's order, and what suits each. */
#ifndef RECTRAY_OPENCL_DEVICE_H
#define RECTRAY_OPENCL_DEVICE_H

#include "base/error.h"

#include <CL/cl.h>

typedef struct DeviceInfo {
    int number; /* for --device */
    char platform[128], name[128], version[128], driver[128];
    char c_version[128]; /* of the language: "OpenCL C 1.2", and what the vendor adds */
    char type[16];       /* "CPU", "GPU", "accelerator" */
    int compute_units;
    int has_double;
    int lanes_float, lanes_double; /* what the backend would use */
    long long memory_bytes;
} DeviceInfo;

/* Lists the devices of all platforms, in the loader's order. *count is their number; the caller frees *devices.
 * No platform or no device is an ERROR_SYSTEM that says what to install. */
bool opencl_devices(DeviceInfo **devices, int *count, Error *error);

/* Finds device `number` (-1: the first PoCL device, else the first of all) and tells about it. threads > 0 limits the
 * processors that PoCL uses; it works for the first call of a process. */
bool opencl_find_device(int number, int threads, cl_device_id *device, DeviceInfo *info, Error *error);

#endif
