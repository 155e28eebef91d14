/* The walkthrough as text, of EVENT_LIGHT, EVENT_LIGHT_END and EVENT_TERMS: what one light does at one point. */
#ifndef RECTRAY_WALKTHROUGH_TEXT_LIGHT_H
#define RECTRAY_WALKTHROUGH_TEXT_LIGHT_H

#include "walkthrough/walkthrough_text_rows.h"

void walkthrough_text_light(WalkthroughText *text, const Event *event);
void walkthrough_text_light_end(WalkthroughText *text, const Event *event);
void walkthrough_text_terms(WalkthroughText *text, const Event *event);

#endif
