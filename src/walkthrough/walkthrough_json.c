/* The walkthrough as JSON: one document with what holds for the whole scene, then the events, one a line, in the order
 * in which they happened. Events are printed as they are made, so that the longest list takes no memory of its own.
 * docs/walkthrough.schema.json describes every member. */
#include "walkthrough/walkthrough_formats.h"
#include "walkthrough/walkthrough_json_event.h"
#include "walkthrough/walkthrough_summary_json.h"

/* Prints the object on one line and deletes it. */
static void print_object(FILE *out, cJSON *object, bool *failed)
{
    char *text = *failed ? NULL : cJSON_PrintUnformatted(object);
    if (text)
        fputs(text, out);
    *failed = !text;
    cJSON_free(text);
    cJSON_Delete(object);
}

static cJSON *request_json(const Walkthrough *walk, bool *failed)
{
    const WalkthroughRequest *request = &walk->request;
    JsonNode node = json_node_new(failed);
    json_node_number(node, "column", request->column);
    json_node_number(node, "row", request->row);
    json_node_number(node, "i", request->i);
    json_node_number(node, "j", request->j);
    json_node_bool(node, "verbose", request->verbose);
    return node.object;
}

static cJSON *scene_json(const Walkthrough *walk, bool *failed)
{
    const Scene *scene = walk->scene;
    View view = view_of(scene);
    JsonNode node = json_node_new(failed);
    json_node_text(node, "file", walk->scene_name);
    json_node_number(node, "columns", view.columns);
    json_node_number(node, "rows", view.rows);
    json_node_number(node, "width", view.width);
    json_node_number(node, "height", view.height);
    json_node_number(node, "grid", walk->grid);
    json_node_bool(node, "adaptive", scene->adaptive);
    json_node_vector(node, "camera", walkthrough_world(scene, view.eye));
    json_node_vector(node, "distance_f", view.forward);
    json_node_vector(node, "r", view.right);
    json_node_vector(node, "u", view.up);
    json_node_vector(node, "centre", scene->centre);
    json_node_number(node, "faces", scene->face_count);
    json_node_number(node, "lights", scene->light_count);
    json_node_text(node, "shadow", scene_shadow_rules[scene->shading.shadow]);
    json_node_text(node, "viewer", scene_viewer_rules[scene->shading.viewer]);
    json_node_number(node, "max_bounces", scene->shading.max_bounces);
    json_node_vector(node, "background", scene->shading.background);
    return node.object;
}

static bool print_summary(FILE *out, const Walkthrough *walk, bool *failed, Error *error)
{
    Summary summary;
    if (!summary_make(&summary, walk, error))
        return false;
    JsonNode node = json_node_new(failed);
    walkthrough_summary_json(node, &summary);
    fprintf(out, ",\n\"summary\":");
    print_object(out, node.object, failed);
    summary_free(&summary);
    return true;
}

bool walkthrough_write_json(FILE *out, const Walkthrough *walk, WalkthroughStyle style, Error *error)
{
    bool failed = false;
    fprintf(out, "{\"walkthrough\":1,\n\"pixel\":");
    print_object(out, request_json(walk, &failed), &failed);
    fprintf(out, ",\n\"scene\":");
    print_object(out, scene_json(walk, &failed), &failed);
    if (style.parts != WALKTHROUGH_STEPS && !print_summary(out, walk, &failed, error))
        return false;
    if (style.parts == WALKTHROUGH_SUMMARY) {
        fprintf(out, "}\n");
        return !failed || error_memory(error, "the walkthrough");
    }
    fprintf(out, ",\n\"events\":[");
    WalkthroughPlace place = {0};
    for (long i = 0; i < walk->count && !failed; i++) {
        walkthrough_follow(&place, walk, &walk->events[i]);
        fprintf(out, i > 0 ? ",\n" : "\n");
        print_object(out, walkthrough_event_json(walk, &place, &walk->events[i], &failed), &failed);
    }
    fprintf(out, "\n]}\n");
    return failed ? error_memory(error, "the walkthrough") : true;
}
