/* The words for what a user may choose. */
#include "trace/render.h"

#include <stddef.h>

const char *const render_backends[] = {[BACKEND_OPENCL] = "opencl", [BACKEND_REFERENCE] = "reference", NULL};
const char *const render_precisions[] = {[PRECISION_FLOAT] = "float", [PRECISION_DOUBLE] = "double", NULL};
const char *const render_accels[] = {[ACCEL_AUTO] = "auto", [ACCEL_NONE] = "none", [ACCEL_KDTREE] = "kdtree",
                                     [ACCEL_BVH] = "bvh",   [ACCEL_LBVH] = "lbvh", NULL};
const char *const render_kernels[] = {[KERNEL_PACKET] = "packet", [KERNEL_PLAIN] = "plain", NULL};
const char *const render_arithmetics[] = {[ARITHMETIC_EXACT] = "exact", [ARITHMETIC_TEXTBOOK] = "textbook", NULL};
