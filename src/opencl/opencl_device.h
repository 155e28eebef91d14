/* Finding a device: platforms and devices in the loader's order, and what suits each. */
#ifndef RECTRAY_OPENCL_DEVICE_H
#define RECTRAY_OPENCL_DEVICE_H

#include "opencl/opencl.h"

#include <CL/cl.h>

/* "CL_OUT_OF_RESOURCES" for its code; "an unknown error" for a code that users seldom meet. */
const char *opencl_status_name(cl_int status);

/* Records a failing OpenCL call: its name, the code and the code's name. True when status is CL_SUCCESS. */
bool opencl_ok(Error *error, cl_int status, const char *call);

/* Finds device `number` (-1: the first PoCL device, else the first of all) and tells about it. threads > 0 limits the
 * processors that PoCL uses; it works for the first call of a process. */
bool opencl_find_device(int number, int threads, cl_device_id *device, DeviceInfo *info, Error *error);

#endif
