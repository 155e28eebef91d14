/* The members of EVENT_LIGHT and EVENT_TERMS in JSON. */
#ifndef RECTRAY_WALKTHROUGH_JSON_LIGHT_H
#define RECTRAY_WALKTHROUGH_JSON_LIGHT_H

#include "walkthrough/walkthrough.h"
#include "json/json_node.h"

void walkthrough_json_light(JsonNode node, const Scene *scene, const WalkthroughPlace *place, const Event *event);
void walkthrough_json_terms(JsonNode node, const Scene *scene, const WalkthroughPlace *place, const Event *event);

#endif
