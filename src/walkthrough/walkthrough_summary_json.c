/* A walkthrough in short, as JSON. A new member goes into docs/walkthrough.schema.json, too. */
#include "walkthrough/walkthrough_summary_json.h"

#include "walkthrough/walkthrough_words.h"

static void put_face(JsonNode node, const char *name, const Scene *scene, int face)
{
    json_node_text(node, name, walkthrough_face_words(scene, face, 60).text);
}

static void put_hit(JsonNode node, const Summary *summary, const SummaryHit *hit)
{
    const Scene *scene = summary->walk->scene;
    put_face(node, "face", scene, hit->face);
    json_node_number(node, "distance", hit->distance);
    json_node_number(node, "weight", hit->weight);
    json_node_vector(node, "illumination", hit->illumination);
    json_node_vector(node, "contribution", hit->contribution);
    JsonNode lights = json_node_array(node, "lights");
    for (int i = 0; i < scene->light_count; i++) {
        JsonNode light = json_node_append_object(lights);
        json_node_number(light, "light", hit->lights[i].light);
        json_node_text(light, "verdict", walkthrough_light_verdicts[hit->lights[i].verdict]);
        if (hit->lights[i].verdict == LIGHT_BLOCKED)
            put_face(light, "blocker", scene, hit->lights[i].blocker);
    }
}

static void put_around(JsonNode node, const WalkthroughAround *around, const WalkthroughRequest *request)
{
    JsonNode pixels = json_node_array(node, "around");
    for (int k = 0; k < 9; k++) {
        if (!around->there[k])
            continue;
        JsonNode pixel = json_node_append_object(pixels);
        json_node_number(pixel, "column", request->column + k % 3 - 1);
        json_node_number(pixel, "row", request->row + k / 3 - 1);
        json_node_vector(pixel, "rgb", vec3(around->rgb[k][0], around->rgb[k][1], around->rgb[k][2]));
    }
}

void walkthrough_summary_json(JsonNode node, const Summary *summary)
{
    JsonNode hits = json_node_array(node, "hits");
    for (int i = 0; i < summary->hit_count; i++)
        put_hit(json_node_append_object(hits), summary, &summary->hits[i]);
    if (summary->missed) {
        JsonNode background = json_node_object(node, "background");
        json_node_number(background, "weight", summary->background_weight);
        json_node_vector(background, "contribution", summary->background);
    }
    json_node_text(node, "end", summary->end.text);
    json_node_vector(node, "colour", summary->colour);
    json_node_number(node, "samples", summary->samples);
    json_node_vector(node, "rgb", vec3(summary->rgb[0], summary->rgb[1], summary->rgb[2]));
    put_around(node, &summary->walk->around, &summary->walk->request);
}
