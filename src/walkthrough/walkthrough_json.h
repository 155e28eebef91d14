/* An event of a walkthrough as a JSON object. */
#ifndef RECTRAY_WALKTHROUGH_JSON_H
#define RECTRAY_WALKTHROUGH_JSON_H

#include "json/json_node.h"
#include "walkthrough/walkthrough.h"

/* The caller deletes the object. *failed is set when memory is wanting. */
cJSON *walk_event_json(const Walkthrough *walk, const WalkPlace *place, const Event *event, bool *failed);

#endif
