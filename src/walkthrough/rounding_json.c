/* The textbook's path beside the exact one, as JSON. docs/rounding.schema.json describes every member. */
#include "walkthrough/rounding_words.h"
#include "json/json_node.h"

static void put_rgb(JsonNode node, const unsigned char *rgb)
{
    JsonNode list = json_node_array(node, "rgb");
    for (int c = 0; c < 3; c++)
        json_node_append_number(list, rgb[c]);
}

static void put_light(JsonNode lights, const RoundingLight *light)
{
    JsonNode node = json_node_append_object(lights);
    json_node_number(node, "height", light->height);
    json_node_text(node, "verdict", walkthrough_light_verdicts[light->verdict]);
    if (light->blocker >= 0)
        json_node_number(node, "blocker", light->blocker);
}

static void put_hit(JsonNode hits, const Scene *scene, const RoundingHit *hit)
{
    JsonNode node = json_node_append_object(hits);
    json_node_number(node, "face", hit->face);
    if (hit->face < 0)
        return;
    json_node_number(node, "t", hit->t);
    json_node_vector(node, "point", walkthrough_world(scene, hit->point));
    json_node_vector(node, "shifted", walkthrough_world(scene, hit->shifted));
    json_node_number(node, "above", hit->above);
    JsonNode lights = json_node_array(node, "lights");
    for (int i = 0; i < hit->light_count; i++)
        put_light(lights, &hit->lights[i]);
}

static void put_path(JsonNode parent, const char *name, const Scene *scene, const RoundingPath *path)
{
    JsonNode node = json_node_object(parent, name), hits = json_node_array(node, "hits");
    for (int k = 0; k < path->count; k++)
        put_hit(hits, scene, &path->hits[k]);
    json_node_vector(node, "colour", path->colour);
    put_rgb(node, path->rgb);
}

static void put_part(JsonNode parent, const Rounding *rounding)
{
    RoundingPart part = rounding_part(rounding);
    if (part.hit < 0)
        return;
    JsonNode node = json_node_object(parent, "part");
    json_node_number(node, "hit", part.hit + 1);
    if (part.light >= 0)
        json_node_number(node, "light", part.light);
    json_node_text(node, "textbook", rounding_textbook_words(rounding, part).text);
    json_node_text(node, "exact", rounding_exact_words(rounding, part).text);
}

bool rounding_write_json(FILE *out, const Rounding *rounding, Error *error)
{
    bool failed = false;
    const WalkthroughRequest *request = &rounding->walk->request;
    JsonNode node = json_node_new(&failed);
    json_node_number(node, "rounding", 1);
    json_node_text(node, "file", rounding->walk->scene_name);
    json_node_number(node, "column", request->column);
    json_node_number(node, "row", request->row);
    json_node_number(node, "i", request->i);
    json_node_number(node, "j", request->j);
    json_node_text(node, "precision", render_precisions[rounding->precision]);
    json_node_number(node, "shift", (double)rounding->shift);
    put_path(node, "textbook", rounding->walk->scene, &rounding->textbook);
    put_path(node, "exact", rounding->walk->scene, &rounding->exact);
    put_part(node, rounding);
    char *text = failed ? NULL : cJSON_PrintUnformatted(node.object);
    if (text)
        fprintf(out, "%s\n", text);
    cJSON_free(text);
    cJSON_Delete(node.object);
    return text || error_memory(error, "the walkthrough");
}
