/* Where the walkthroughs of two pixels part. */
#ifndef RECTRAY_WALKTHROUGH_DIFF_H
#define RECTRAY_WALKTHROUGH_DIFF_H

#include "walkthrough/walkthrough_formats.h"

/* Prints what differs between the first walkthrough and each other one, as text: where the paths part, then
 * the events that are not the same, in the order of the path. False for want of memory. */
bool walkthrough_diff(FILE *out, const Walkthrough *walks, int count, WalkthroughStyle style, Error *error);

#endif
