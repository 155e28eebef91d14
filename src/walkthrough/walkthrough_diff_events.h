/* Two walkthroughs event by event, as text. */
#ifndef RECTRAY_WALKTHROUGH_DIFF_EVENTS_H
#define RECTRAY_WALKTHROUGH_DIFF_EVENTS_H

#include "walkthrough/ink.h"
#include "walkthrough/walkthrough.h"

/* Prints a row for each event that is not the same in both, in the order of the path: what the first one has, and what
 * the other one has. */
void walkthrough_diff_events(const Ink *ink, const Walkthrough *first, const Walkthrough *other);

#endif
