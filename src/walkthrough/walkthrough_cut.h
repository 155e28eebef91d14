/* A text of steps as JSON, for the web page. */
#ifndef RECTRAY_WALKTHROUGH_CUT_H
#define RECTRAY_WALKTHROUGH_CUT_H

#include "walkthrough/walkthrough_formats.h"
#include "json/json_node.h"

/* Writes the text, and tells style.listener of its steps. False for want of memory. */
typedef bool WalkthroughCutWriter(FILE *out, const void *what, WalkthroughStyle style, Error *error);

/* Puts two members into the node: "head", the text before the first step, and "steps", each with its text and what it
 * is about. */
void walkthrough_cut(JsonNode node, WalkthroughCutWriter *write, const void *what, WalkthroughStyle style,
                     Error *error);

#endif
