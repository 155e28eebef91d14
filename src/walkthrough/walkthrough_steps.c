/* The walkthrough as an answer and its steps, for the web page: one JSON object. First what a reader wants to know at
 * once: the path, what each hit adds, which lights reach it, why the path ended. Then the text, cut into its steps. */
#include "walkthrough/walkthrough_formats.h"

#include "walkthrough/walkthrough_cut.h"
#include "walkthrough/walkthrough_summary.h"
#include "walkthrough/walkthrough_summary_lights.h"
#include "walkthrough/walkthrough_words.h"
/* --- The answer --- */

/* What the path meets, one after the other, in the words of the text's summary. */
static void put_path(JsonNode node, const Summary *summary)
{
    JsonNode path = json_node_array(node, "path");
    json_node_append_text(path, "camera");
    for (int i = 0; i < summary->hit_count; i++) {
        InkText face = walkthrough_face_words(summary->walk->scene, summary->hits[i].face, 40);
        json_node_append_text(path, ink_text("P%d %s", i + 1, face.text).text);
    }
    if (summary->missed)
        json_node_append_text(path, "out of the scene");
}

static void put_light(JsonNode lights, const Scene *scene, const SummaryLight *light)
{
    JsonNode node = json_node_append_object(lights);
    json_node_number(node, "light", light->light);
    json_node_text(node, "verdict", walkthrough_light_verdicts[light->verdict]);
    if (light->verdict == LIGHT_BLOCKED)
        json_node_text(node, "blocker", walkthrough_face_words(scene, light->blocker, 40).text);
}

static void put_contribution(JsonNode node, double weight, Vec3 contribution)
{
    json_node_text(node, "weight", ink_number(weight, INK_DIGITS).text);
    json_node_vector(node, "contribution", contribution);
    json_node_text(node, "words", ink_vector(contribution, INK_DIGITS).text);
}

static void put_hit(JsonNode hits, const Summary *summary, int index)
{
    const Scene *scene = summary->walk->scene;
    const SummaryHit *hit = &summary->hits[index];
    JsonNode node = json_node_append_object(hits);
    json_node_text(node, "name", ink_text("P%d", index + 1).text);
    json_node_text(node, "face", walkthrough_face_words(scene, hit->face, 40).text);
    json_node_text(node, "material", scene->materials[scene->faces[hit->face].material].name);
    put_contribution(node, hit->weight, hit->contribution);
    json_node_text(node, "lights_words", walkthrough_summary_lights(summary, hit, INK_MOST_COLUMNS).text);
    JsonNode lights = json_node_array(node, "lights");
    for (int i = 0; i < scene->light_count; i++)
        put_light(lights, scene, &hit->lights[i]);
}

static void put_answer(JsonNode node, const Walkthrough *walk, Error *error)
{
    Summary summary;
    if (!summary_make(&summary, walk, error)) {
        *node.failed = true;
        return;
    }
    put_path(node, &summary);
    JsonNode hits = json_node_array(node, "hits");
    for (int i = 0; i < summary.hit_count; i++)
        put_hit(hits, &summary, i);
    if (summary.missed)
        put_contribution(json_node_object(node, "background"), summary.background_weight, summary.background);
    json_node_text(node, "end", ink_text("The path ends: %s.", summary.end.text).text);
    json_node_vector(node, "sum", summary.colour);
    json_node_text(node, "pixel", walkthrough_pixel_words(walk, &walk->events[walk->count - 1]).text);
    json_node_vector(node, "rgb", vec3(summary.rgb[0], summary.rgb[1], summary.rgb[2]));
    json_node_number(node, "samples", summary.samples);
    summary_free(&summary);
}

static bool write_text(FILE *out, const void *walk, WalkthroughStyle style, Error *error)
{
    style.parts = WALKTHROUGH_STEPS;
    return walkthrough_write_text(out, walk, style, error);
}

bool walkthrough_write_steps(FILE *out, const Walkthrough *walk, WalkthroughStyle style, Error *error)
{
    bool failed = false;
    JsonNode node = json_node_new(&failed);
    put_answer(node, walk, error);
    walkthrough_cut(node, write_text, walk, style, error);
    char *text = failed ? NULL : cJSON_PrintUnformatted(node.object);
    if (text)
        fputs(text, out);
    cJSON_free(text);
    cJSON_Delete(node.object);
    return text || error_memory(error, "the walkthrough");
}
