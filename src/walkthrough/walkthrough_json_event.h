/* An event of a walkthrough as a JSON object. */
#ifndef RECTRAY_WALKTHROUGH_JSON_EVENT_H
#define RECTRAY_WALKTHROUGH_JSON_EVENT_H

#include "walkthrough/walkthrough.h"
#include "json/json_node.h"

/* The caller deletes the object. *failed is set when memory is wanting. */
cJSON *walkthrough_event_json(const Walkthrough *walk, const WalkthroughPlace *place, const Event *event, bool *failed);

/* What the member "event" says of such an event. */
const char *walkthrough_event_name(EventKind kind);

#endif
