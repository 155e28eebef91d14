/* Is a device right? Each kernel is compiled for it and renders two small scenes that are inside the program, and what
 * comes out is held against the reference. To add a kernel: its line in device_check.c's table, and its case there. */
#ifndef RECTRAY_DEVICE_CHECK_H
#define RECTRAY_DEVICE_CHECK_H

#include "opencl/opencl_device.h"

/* One kernel on one scene. */
typedef struct DeviceCheckStep {
    const char *kernel, *scene;
    bool ran;                    /* else `message` says why not */
    double compile_ms, trace_ms; /* zero where it did not run */
    long compared;               /* pixels, or rays */
    long off;                    /* of them: pixels off by more than the kernel may be, rays with another hit */
    int most_off;                /* the largest difference of two pixels, in steps of 1/255; of rays: 0 */
    bool right;                  /* it ran, and no more of them are off than may be */
    char message[1024];
} DeviceCheckStep;

enum { DEVICE_CHECK_MAX_STEPS = 16 };

typedef struct DeviceCheck {
    DeviceInfo device;
    DeviceCheckStep steps[DEVICE_CHECK_MAX_STEPS];
    int count, wrong; /* wrong: of the steps */
} DeviceCheck;

/* Told before and after each step, so that the user sees which one a driver breaks off. */
typedef struct DeviceCheckListener {
    void (*before)(void *user, const DeviceCheckStep *step); /* its names only */
    void (*after)(void *user, const DeviceCheckStep *step);
    void *user;
} DeviceCheckListener;

/* Checks device `number`, -1 for the default. Kernels that an earlier run has kept are not used. A device that is wrong
 * is no error: `wrong` tells. Errors: no such device, memory. */
bool device_check(DeviceCheck *check, int number, DeviceCheckListener listener, Error *error);

#endif
