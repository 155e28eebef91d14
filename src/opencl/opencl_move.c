/* What depends on the camera and the lights, and what only seems not to. */
#include "opencl/opencl_move.h"

#include "base/clock.h"
#include "opencl/device_scene.h"
#include "opencl/opencl_status.h"

#include <stdlib.h>
#include <string.h>

static bool same_faces(const PrunedScene *before, const PrunedScene *next)
{
    if (before->scene.face_count != next->scene.face_count || !before->faces != !next->faces)
        return false;
    /* Those that were left out may be others, in the same number. */
    return !next->faces ||
           memcmp(before->faces, next->faces, (size_t)next->scene.face_count * sizeof *next->faces) == 0;
}

bool opencl_move_is_possible(const SceneOnDevice *on_device, const PrunedScene *before, const PrunedScene *next,
                             const RenderSettings *settings, Error *error)
{
    if (!same_faces(before, next) || before->scene.light_count != next->scene.light_count)
        return false;
    unsigned char *closed = opencl_closed_boxes(&next->scene, settings, error);
    bool same = closed && memcmp(closed, on_device->closed, (size_t)next->scene.face_count) == 0;
    free(closed);
    return same;
}

static bool write(OpenclSession *session, cl_mem buffer, const DeviceReals *reals, Error *error)
{
    return opencl_ok(
        error,
        clEnqueueWriteBuffer(session->queue, buffer, CL_TRUE, 0, device_reals_bytes(reals), reals->data, 0, NULL, NULL),
        "clEnqueueWriteBuffer");
}

bool opencl_move(OpenclSession *session, const SceneOnDevice *on_device, const Scene *scene, RenderReport *report,
                 Error *error)
{
    double start = clock_ms();
    DeviceScene packed = {.lights = {.count = 0}};
    bool ok = device_scene_pack_moving(&packed, scene, session->precision, error) &&
              write(session, on_device->lights, &packed.lights, error) &&
              write(session, on_device->view, &packed.view, error);
    device_scene_free(&packed);
    report->upload_ms += clock_ms() - start;
    return ok;
}
