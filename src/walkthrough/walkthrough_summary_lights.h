/* Which lights reach a hit, and what keeps the others away, in a line. */
#ifndef RECTRAY_WALKTHROUGH_SUMMARY_LIGHTS_H
#define RECTRAY_WALKTHROUGH_SUMMARY_LIGHTS_H

#include "walkthrough/walkthrough_summary.h"

/* "lights 0, 2 reach it; light 1 is behind the face; light 3 blocked by ceiling/3"; where that is too wide, only one of
 * the faces in the way is named. */
InkText walkthrough_summary_lights(const Summary *summary, const SummaryHit *hit, int columns);

/* "2 of 3 lights reach it". */
InkText walkthrough_summary_light_count(const Summary *summary, const SummaryHit *hit);

#endif
