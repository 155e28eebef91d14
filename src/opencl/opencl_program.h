/* The programs of a session: the compiled kernels. */
#ifndef RECTRAY_OPENCL_PROGRAM_H
#define RECTRAY_OPENCL_PROGRAM_H

#include "opencl/opencl_session.h"

/* What the kernels are built for: a build option each. */
typedef struct Variant {
    AccelKind accel; /* not ACCEL_AUTO */
    int node_width;
    int stack_size; /* nodes that a traversal may have to remember */
} Variant;

/* Builds the session's programs: from the sources embedded in rectray, or from the files of the folder that
 * the environment variable RECTRAY_KERNELS names (unless it is empty), or from what an
 * earlier run has kept of the same sources. Time and build options go to the report. A
 * kernel that does not compile is an ERROR_SYSTEM with the compiler's log. */
bool opencl_build(OpenclSession *session, Variant variant, RenderReport *report, Error *error);

/* Keeps the programs for later runs if they were compiled in this one; to be called when each kernel has run once. */
void opencl_keep(OpenclSession *session);

#endif
