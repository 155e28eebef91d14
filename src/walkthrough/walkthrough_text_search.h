/* The walkthrough as text, of EVENT_TALLY, EVENT_FACE and EVENT_OCCLUDER: the search for faces. */
#ifndef RECTRAY_WALKTHROUGH_TEXT_SEARCH_H
#define RECTRAY_WALKTHROUGH_TEXT_SEARCH_H

#include "walkthrough/walkthrough_text_rows.h"

void walkthrough_text_tally(WalkthroughText *text, const Event *event);
void walkthrough_text_face_tested(WalkthroughText *text, const Event *event);
void walkthrough_text_occluder_tested(WalkthroughText *text, const Event *event);

#endif
