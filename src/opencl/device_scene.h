/* A scene as the kernels want it: the records and rows of kernels/shared/layout.h, in float or double. */
#ifndef RECTRAY_DEVICE_SCENE_H
#define RECTRAY_DEVICE_SCENE_H

#include "opencl/device_faces.h"

typedef struct DeviceScene {
    DeviceFaces faces;
    DeviceReals materials, lights, view;
} DeviceScene;

/* Packs the scene; device_scene_free frees the copy, also after a failure. */
bool device_scene_pack(DeviceScene *packed, const Scene *scene, const DevicePacking *how, Error *error);

/* The lights and the view of a scene alone, into a zeroed DeviceScene. */
bool device_scene_pack_moving(DeviceScene *packed, const Scene *scene, Precision precision, Error *error);

void device_scene_free(DeviceScene *packed);

/* About how much memory a process takes at most that renders so many faces through OpenCL, with a kept kernel. */
double device_scene_process_bytes(int face_count);

#endif
