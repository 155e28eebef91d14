/* Rays cast at a scene with the reference tracer, one after the other. */
#include "trace/reference_cast.h"

#include "base/clock.h"
#include "trace/reference.h"

#include <string.h>

void reference_cast(const Scene *scene, const Accel *accel, const double *rays, long count, CastHit *hits,
                    RenderReport *report)
{
    double start = clock_ms();
    Tracer tracer = {.scene = scene, .accel = accel, .report = report};
    for (long i = 0; i < count; i++) {
        const double *ray = rays + 6 * i;
        hits[i] = reference_nearest(&tracer, (Ray){vec3(ray[0], ray[1], ray[2]), vec3(ray[3], ray[4], ray[5])}, -1);
    }
    report->trace_ms = clock_ms() - start;
    report->lanes = 1;
    report->accel = accel->kind;
    strcpy(report->device, "reference");
}
