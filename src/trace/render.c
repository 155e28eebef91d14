/* The words for what a user may choose, and the part of the picture that is rendered. */
#include "trace/render.h"

#include <stddef.h>

const char *const render_backends[] = {[BACKEND_OPENCL] = "opencl", [BACKEND_REFERENCE] = "reference", NULL};
const char *const render_precisions[] = {[PRECISION_FLOAT] = "float", [PRECISION_DOUBLE] = "double", NULL};
const char *const render_accels[] = {[ACCEL_AUTO] = "auto", [ACCEL_NONE] = "none", [ACCEL_KDTREE] = "kdtree",
                                     [ACCEL_BVH] = "bvh",   [ACCEL_LBVH] = "lbvh", NULL};
const char *const render_kernels[] = {
    [KERNEL_AUTO] = "auto", [KERNEL_PACKET] = "packet", [KERNEL_PLAIN] = "plain", [KERNEL_GPU] = "gpu", NULL};
const char *const render_arithmetics[] = {[ARITHMETIC_EXACT] = "exact", [ARITHMETIC_TEXTBOOK] = "textbook", NULL};

Region render_region(const RenderSettings *settings, const Scene *scene)
{
    return settings->region.columns > 0 ? settings->region : (Region){0, 0, scene->screen.columns, scene->screen.rows};
}
