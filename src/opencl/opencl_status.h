/* What OpenCL calls return: every call goes through opencl_ok. */
#ifndef RECTRAY_OPENCL_STATUS_H
#define RECTRAY_OPENCL_STATUS_H

#include "base/error.h"

#include <CL/cl.h>

/* "CL_OUT_OF_RESOURCES" for its code; "an unknown error" for a code that users seldom meet. */
const char *opencl_status_name(cl_int status);

/* Records a failing OpenCL call: its name, the code and the code's name. True when status is CL_SUCCESS. */
bool opencl_ok(Error *error, cl_int status, const char *call);

#endif
