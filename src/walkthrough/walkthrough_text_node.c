/* The walkthrough as text: the nodes of a tree. */
#include "walkthrough/walkthrough_text_node.h"

#include "walkthrough/walkthrough_node.h"

#include <string.h>

enum { NODES_LISTED = 48, LEVELS_INDENTED = 12 };

static const char *is_or_are(int count)
{
    return count == 1 ? "is" : "are";
}

void walkthrough_text_nodes(const WalkthroughText *text, const Event *tally)
{
    const int *counts = tally->as.tally.nodes;
    int told = 0;
    char line[1024];
    size_t used = (size_t)snprintf(line, sizeof line, "    Of %d tree nodes whose boxes are tested, %d %s missed",
                                   tally->as.tally.nodes_met, counts[NODE_MISSED], is_or_are(counts[NODE_MISSED]));
    if (counts[NODE_BEYOND] > 0)
        used += (size_t)snprintf(line + used, sizeof line - used, ", %d begin%s beyond %s", counts[NODE_BEYOND],
                                 counts[NODE_BEYOND] == 1 ? "s" : "",
                                 tally->as.tally.shadow ? "the light" : "the nearest hit");
    if (counts[NODE_UNNEEDED] > 0)
        used += (size_t)snprintf(line + used, sizeof line - used, ", %d %s not needed any more", counts[NODE_UNNEEDED],
                                 is_or_are(counts[NODE_UNNEEDED]));
    used += (size_t)snprintf(line + used, sizeof line - used, ", %d %s entered", counts[NODE_ENTERED],
                             is_or_are(counts[NODE_ENTERED]));
    for (const Event *event = tally + 1;
         event->kind == EVENT_NODE || event->kind == EVENT_FACE || event->kind == EVENT_OCCLUDER; event++) {
        if (event->kind != EVENT_NODE || event->as.node.visit.verdict != NODE_ENTERED || told == NODES_LISTED)
            continue;
        used += (size_t)snprintf(line + used, sizeof line - used, "%s %d%s", told++ > 0 ? "," : ":",
                                 event->as.node.visit.node, event->as.node.shape.leaf ? " (leaf)" : "");
    }
    ink_paragraph(&text->ink, "%s%s.", line, told < counts[NODE_ENTERED] ? ", ..." : "");
    if (!text->walk->request.verbose && text->step == 2)
        ink_paragraph(&text->ink, "    (--verbose tells each with its box and the reason.)");
}

/* "leaf of 2 faces, (0, 0, 0) to (1, 2, 3)", "plane z = 4 at t = 2.5, near child 5, far child 9". */
static InkText shape_words(const WalkthroughText *text, const AccelNode *shape)
{
    const Scene *scene = text->walk->scene;
    const Box *box = &shape->box;
    Ray ray = walkthrough_search_ray(&text->place);
    Vec3 low = walkthrough_world(scene, vec3((double)box->low[0], (double)box->low[1], (double)box->low[2]));
    Vec3 high = walkthrough_world(scene, vec3((double)box->high[0], (double)box->high[1], (double)box->high[2]));
    InkText corners =
        ink_text("%s to %s", ink_vector(low, text->digits - 2).text, ink_vector(high, text->digits - 2).text);
    if (shape->leaf)
        return ink_text("%s, a leaf of %d face%s", corners.text, shape->faces, shape->faces == 1 ? "" : "s");
    if (shape->axis < 0)
        return corners;
    int near = node_near_child(shape, ray), far = near == shape->low ? shape->high : shape->low;
    double t = node_plane_t(shape, ray);
    InkText when = isinf(t) ? ink_text("along the ray") : ink_text("at t = %s", ink_number(t, INK_DIGITS).text);
    return ink_text("%s, cut by %c = %s %s, near child %d, far child %d", corners.text, "xyz"[shape->axis],
                    ink_number((double)shape->split + vec3_component(scene->centre, shape->axis), text->digits).text,
                    when.text, near, far);
}

void walkthrough_text_node(WalkthroughText *text, const Event *event)
{
    const TraversalNode *visit = &event->as.node.visit;
    if (!text->walk->request.verbose)
        return; /* the tally has told it */
    int indent = 6 + 2 * (visit->level < LEVELS_INDENTED ? visit->level : LEVELS_INDENTED);
    ink_hanging(&text->ink, indent + 2, "%*snode %d: %s; %s", indent, "", visit->node,
                node_reason(event, walkthrough_search_ray(&text->place), text->place.shadow).text,
                shape_words(text, &event->as.node.shape).text);
    text->rows_told = false;
}
