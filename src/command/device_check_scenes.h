/* The scenes that a device is checked with, as texts of scene files. */
#ifndef RECTRAY_DEVICE_CHECK_SCENES_H
#define RECTRAY_DEVICE_CHECK_SCENES_H

#include "trace/accel.h"

typedef struct DeviceCheckScene {
    const char *name, *text;
    AccelKind accel;
} DeviceCheckScene;

extern const DeviceCheckScene device_check_scenes[]; /* ends in a NULL name */

#endif
