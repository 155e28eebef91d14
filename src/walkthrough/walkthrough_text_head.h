/* The walkthrough as text: what stands before the steps. */
#ifndef RECTRAY_WALKTHROUGH_TEXT_HEAD_H
#define RECTRAY_WALKTHROUGH_TEXT_HEAD_H

#include "walkthrough/walkthrough_text_rows.h"

void walkthrough_text_head(const WalkthroughText *text);

#endif
