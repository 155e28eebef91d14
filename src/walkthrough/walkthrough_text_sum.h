/* The walkthrough as text, of EVENT_PATH_END and EVENT_PIXEL: the sum. */
#ifndef RECTRAY_WALKTHROUGH_TEXT_SUM_H
#define RECTRAY_WALKTHROUGH_TEXT_SUM_H

#include "walkthrough/walkthrough_text_rows.h"

void walkthrough_text_path_end(WalkthroughText *text, const Event *event);
void walkthrough_text_pixel(WalkthroughText *text, const Event *event);

#endif
