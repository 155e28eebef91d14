/* The walkthrough as text, of EVENT_NODE: the nodes of a tree. */
#ifndef RECTRAY_WALKTHROUGH_TEXT_NODE_H
#define RECTRAY_WALKTHROUGH_TEXT_NODE_H

#include "walkthrough/walkthrough_text_rows.h"

/* In short, of a tally: how many nodes became what, and which were entered. */
void walkthrough_text_nodes(const WalkthroughText *text, const Event *tally);

/* One node: its box, or the plane that cuts it, and why it is entered or passed over. */
void walkthrough_text_node(WalkthroughText *text, const Event *event);

#endif
