/* The walkthrough as text, of EVENT_HIT: the point where the ray hits the nearest face. */
#ifndef RECTRAY_WALKTHROUGH_TEXT_HIT_H
#define RECTRAY_WALKTHROUGH_TEXT_HIT_H

#include "walkthrough/walkthrough_text_rows.h"

void walkthrough_text_hit(WalkthroughText *text, const Event *event);

#endif
