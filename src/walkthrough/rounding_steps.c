/* What rounding does to one pixel, step by step, for the web page: one JSON object. */
#include "walkthrough/rounding.h"
#include "walkthrough/walkthrough_cut.h"

#include <stdlib.h>

static bool write_text(FILE *out, const void *rounding, WalkthroughStyle style, Error *error)
{
    (void)error;
    rounding_write_text(out, rounding, style);
    return true;
}

static void put_part(JsonNode list, RoundingPart part)
{
    JsonNode node = json_node_append_object(list);
    json_node_number(node, "hit", part.hit + 1);
    json_node_number(node, "light", part.light);
}

/* What stands before the steps. */
static void put_summary(JsonNode node, const Rounding *rounding, WalkthroughStyle style)
{
    char *text = NULL;
    size_t length;
    FILE *out = open_memstream(&text, &length);
    style.parts = WALKTHROUGH_SUMMARY;
    if (out)
        rounding_write_text(out, rounding, style);
    *node.failed = *node.failed || !out || fclose(out) != 0;
    if (!*node.failed)
        json_node_text(node, "summary", text);
    free(text);
}

/* As the steps are: lights are compared as long as both are at the same face. */
static void put_parts(JsonNode node, const Rounding *rounding)
{
    JsonNode list = json_node_array(node, "parts");
    for (int k = 0; k < rounding->exact.count; k++) {
        if (!rounding_same_face(rounding, k)) {
            put_part(list, (RoundingPart){k, -1});
            return;
        }
        for (int light = 0; light < rounding->exact.hits[k].light_count; light++)
            if (!rounding_same_verdict(rounding, k, light))
                put_part(list, (RoundingPart){k, light});
    }
}

bool rounding_write_steps(FILE *out, const Rounding *rounding, WalkthroughStyle style, Error *error)
{
    bool failed = false;
    JsonNode node = json_node_new(&failed);
    put_summary(node, rounding, style);
    walkthrough_cut(node, write_text, rounding, style, error);
    put_parts(node, rounding);
    char *text = failed ? NULL : cJSON_PrintUnformatted(node.object);
    if (text)
        fputs(text, out);
    cJSON_free(text);
    cJSON_Delete(node.object);
    return text || error_memory(error, "the walkthrough");
}
