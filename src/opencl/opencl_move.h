/* A scene on a device, seen from elsewhere and in another light: its faces and its tree stay where they are. */
#ifndef RECTRAY_OPENCL_MOVE_H
#define RECTRAY_OPENCL_MOVE_H

#include "opencl/opencl_upload.h"
#include "trace/pruned_scene.h"

/* Whether what the device has of a scene's faces, pruned as `before`, holds for the same faces pruned as `next`. It
 * depends on the camera and the lights which faces are left out, and which are a closed box's. The device has lights in
 * the number of `before`. False, too, with the error filled, without memory. */
bool opencl_move_is_possible(const SceneOnDevice *on_device, const PrunedScene *before, const PrunedScene *next,
                             const RenderSettings *settings, Error *error);

/* Writes the scene's lights and its view; the time goes to the report. */
bool opencl_move(OpenclSession *session, const SceneOnDevice *on_device, const Scene *scene, RenderReport *report,
                 Error *error);

#endif
