/* A scene as the kernels want it: the records and rows of kernels/layout.h, in float or double. */
#ifndef RECTRAY_DEVICE_SCENE_H
#define RECTRAY_DEVICE_SCENE_H

#include "trace/render.h"
#include "scene/scene.h"

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
    DeviceReals edges, planes, materials, lights, view;
} DeviceScene;

/* Packs the scene, its faces in the given order (NULL: as they are), those marked in `closed` (by their place in the scene; NULL:
 * none) as faces of closed boxes, planes in the precision `wide`, the other rows in `precision`; on so many threads (0: one per
 * processor). device_scene_free frees the copy, also after a failure. */
bool device_scene_pack(DeviceScene *packed, const Scene *scene, const unsigned char *closed, const int *order, int threads,
                       Precision precision, Precision wide, Error *error);
void device_scene_free(DeviceScene *packed);

size_t device_reals_bytes(const DeviceReals *reals);

#endif
