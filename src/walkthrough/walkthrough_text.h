/* The steps of the text, event by event, for whoever says more between them: rounding_text.c. */
#ifndef RECTRAY_WALKTHROUGH_TEXT_H
#define RECTRAY_WALKTHROUGH_TEXT_H

#include "walkthrough/walkthrough_text_rows.h"

/* What the event is about, after text->place follows it. */
void walkthrough_text_event(WalkthroughText *text, const Event *event);

/* Where a ray begins: the heading of its search. */
void walkthrough_text_search_begin(WalkthroughText *text, const Event *event);

#endif
