/* The members of EVENT_TALLY and EVENT_NODE in JSON: the search for faces. */
#ifndef RECTRAY_WALKTHROUGH_JSON_NODE_H
#define RECTRAY_WALKTHROUGH_JSON_NODE_H

#include "walkthrough/walkthrough.h"
#include "json/json_node.h"

void walkthrough_json_tally(JsonNode node, const Event *event);
void walkthrough_json_node(JsonNode node, const Scene *scene, const WalkthroughPlace *place, const Event *event);

#endif
