/* The faces of a scene as rows and records for the kernels, eight faces at a time. */
#ifndef RECTRAY_DEVICE_FACES_H
#define RECTRAY_DEVICE_FACES_H

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

size_t device_reals_bytes(const DeviceReals *reals);

typedef struct DeviceFaces {
    FaceRecord *records;
    DeviceReals rows, planes;
} DeviceFaces;

/* How a scene is packed. */
typedef struct DevicePacking {
    const int *order;            /* of the faces; NULL: as they are in the scene */
    const unsigned char *closed; /* by skip_closed_boxes; NULL: no face is a closed box's */
    Precision precision, wide;   /* wide: of the planes */
    int threads;                 /* 0: one per processor */
    Spent spent;                 /* told where the planes are packed in double, from which all else is then made */
} DevicePacking;

/* Fills the records and rows, for which there is memory: one of each for a face of the scene. */
void device_faces_pack(DeviceFaces *faces, const Scene *scene, const DevicePacking *how);

#endif
