/* An event of a walkthrough as a JSON object. Floor 5. */
#ifndef RECTRAY_WALKTHROUGH_JSON_H
#define RECTRAY_WALKTHROUGH_JSON_H

#include "json_node.h"
#include "walkthrough.h"

/* The caller deletes the object. *failed is set when memory is wanting. */
cJSON *walk_event_json(const Walkthrough *walk, const WalkPlace *place, const Event *event, bool *failed);

#endif
