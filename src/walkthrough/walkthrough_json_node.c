/* The search for faces, as members of JSON objects. */
#include "walkthrough/walkthrough_json_node.h"

#include "walkthrough/walkthrough_node.h"

static const char *const axes[] = {"x", "y", "z"};

void walkthrough_json_tally(JsonNode node, const Event *event)
{
    json_node_text(node, "ray", event->as.tally.shadow ? "shadow" : "path");
    json_node_number(node, "tested", event->as.tally.tested);
    JsonNode verdicts = json_node_object(node, "verdicts");
    for (int k = 0; k < FACE_VERDICT_COUNT; k++)
        json_node_number(verdicts, walkthrough_face_verdicts[k], event->as.tally.verdicts[k]);
    if (event->as.tally.nodes_met == 0)
        return;
    JsonNode nodes = json_node_object(node, "nodes");
    json_node_number(nodes, "met", event->as.tally.nodes_met);
    for (int k = 0; k < NODE_VERDICT_COUNT; k++)
        json_node_number(nodes, walkthrough_node_verdicts[k], event->as.tally.nodes[k]);
    json_node_number(nodes, "leaves", event->as.tally.leaves);
}

/* Where the ray crosses the planes of one axis; none where it begins inside or never leaves. */
static void put_crossing(JsonNode node, const char *name, int axis, double t)
{
    if (axis < 0)
        return;
    JsonNode crossing = json_node_object(node, name);
    json_node_text(crossing, "axis", axes[axis]);
    json_node_number(crossing, "t", t);
}

void walkthrough_json_node(JsonNode node, const Scene *scene, const WalkthroughPlace *place, const Event *event)
{
    const TraversalNode *visit = &event->as.node.visit;
    const AccelNode *shape = &event->as.node.shape;
    const Box *box = &shape->box;
    Ray ray = walkthrough_search_ray(place);
    json_node_number(node, "node", visit->node);
    json_node_number(node, "level", visit->level);
    json_node_bool(node, "leaf", shape->leaf);
    json_node_number(node, "faces", shape->faces);
    json_node_bool(node, "entered", visit->verdict == NODE_ENTERED);
    json_node_text(node, "verdict", walkthrough_node_verdicts[visit->verdict]);
    json_node_vector(node, "low",
                     walkthrough_world(scene, vec3((double)box->low[0], (double)box->low[1], (double)box->low[2])));
    json_node_vector(node, "high",
                     walkthrough_world(scene, vec3((double)box->high[0], (double)box->high[1], (double)box->high[2])));
    if (visit->verdict != NODE_MISSED) {
        JsonNode inside = json_node_array(node, "inside");
        json_node_append_number(inside, visit->inside.enter);
        json_node_append_number(inside, visit->inside.leave);
    }
    NodeCrossing crossing = node_crossing(*box, ray);
    put_crossing(node, "enters", crossing.enter_axis, crossing.enter);
    put_crossing(node, "leaves", crossing.leave_axis, crossing.leave);
    json_node_number(node, "limit", visit->limit);
    if (shape->axis < 0)
        return;
    int near = node_near_child(shape, ray);
    json_node_text(node, "axis", axes[shape->axis]);
    json_node_number(node, "split", (double)shape->split + vec3_component(scene->centre, shape->axis));
    json_node_number(node, "split_t", node_plane_t(shape, ray));
    json_node_number(node, "near", near);
    json_node_number(node, "far", near == shape->low ? shape->high : shape->low);
}
