/* Traces a pixel with a slip. */
#ifndef RECTRAY_SLIP_TRACE_H
#define RECTRAY_SLIP_TRACE_H

#include "grade/slip_steps.h"
#include "walkthrough/walkthrough.h"

/* Records what a tracer with these steps finds in the samples that `right` has. Faces that are tested and missed are
 * not told. Every face is tested, so the time grows with the scene. Free `walk` also after a failure, which is want of
 * memory. */
bool slip_trace(Walkthrough *walk, const Walkthrough *right, const SlipSteps *slip, Error *error);

#endif
