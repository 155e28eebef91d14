/* A scene as the kernels want it: the records and rows of kernels/shared/layout.h, in float or double. */
#ifndef RECTRAY_DEVICE_SCENE_H
#define RECTRAY_DEVICE_SCENE_H

#include "scene/scene.h"
#include "trace/render.h"

#include "kernels/shared/layout.h"

#include <stddef.h>

/* Rows of reals, `count` values of 4 (float) or 8 (double) bytes. */
typedef struct DeviceReals {
    void *data;
    size_t count;
    Precision precision;
} DeviceReals;

typedef struct DeviceScene {
    FaceRecord *faces;
    DeviceReals face_rows, planes, materials, lights, view;
} DeviceScene;

/* How a scene is packed. */
typedef struct DevicePacking {
    const int *order;            /* of the faces; NULL: as they are in the scene */
    const unsigned char *closed; /* by skip_closed_boxes; NULL: no face is a closed box's */
    Precision precision, wide;   /* wide: of the planes */
    int threads;                 /* 0: one per processor */
    Spent spent;                 /* told where the planes are packed in double, from which all else is then made */
} DevicePacking;

/* Packs the scene; device_scene_free frees the copy, also after a failure. */
bool device_scene_pack(DeviceScene *packed, const Scene *scene, const DevicePacking *how, Error *error);
void device_scene_free(DeviceScene *packed);

/* About how much memory a process takes at most that renders so many faces through OpenCL, with a kept kernel. */
double device_scene_process_bytes(int face_count);

size_t device_reals_bytes(const DeviceReals *reals);

#endif
