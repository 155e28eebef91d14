/* A walkthrough in short, as JSON. */
#ifndef RECTRAY_WALKTHROUGH_SUMMARY_JSON_H
#define RECTRAY_WALKTHROUGH_SUMMARY_JSON_H

#include "walkthrough/walkthrough_summary.h"
#include "json/json_node.h"

/* Its members; docs/walkthrough.schema.json describes them. */
void walkthrough_summary_json(JsonNode node, const Summary *summary);

#endif
