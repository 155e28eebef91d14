/* A walkthrough as a list of JSON objects. */
#include "grade/expected.h"

#include "walkthrough/walkthrough_json_event.h"
#include "walkthrough/walkthrough_words.h"
#include "json/json_node.h"

#include <stdlib.h>

enum { NAME_COLUMNS = 60 };

static bool is_told(const WalkthroughPlace *place, const Event *event)
{
    return event->kind == EVENT_PIXEL || (event->kind != EVENT_ADAPTIVE && place->told);
}

/* What a summary says of a hit, too. */
static void put_more(cJSON *object, const Walkthrough *walk, const WalkthroughPlace *place, const Event *event,
                     bool *failed)
{
    JsonNode node = {object, failed};
    if (event->kind != EVENT_HIT)
        return;
    json_node_number(node, "distance", event->as.hit.test.t * place->length);
    json_node_text(node, "name", walkthrough_face_words(walk->scene, event->as.hit.face, NAME_COLUMNS).text);
}

/* Numbers that were written with all their digits become numbers to compare with. */
static void read_numbers(cJSON *item)
{
    for (cJSON *child = item->child; child; child = child->next)
        read_numbers(child);
    if (cJSON_IsRaw(item)) {
        item->valuedouble = strtod(item->valuestring, NULL);
        item->type = cJSON_Number;
    }
}

bool expected_make(Expected *expected, const Walkthrough *walk, Error *error)
{
    WalkthroughPlace place = {0};
    bool failed = false;
    *expected = (Expected){.events = calloc((size_t)walk->count + 1, sizeof *expected->events)};
    if (!expected->events)
        return error_memory(error, "a walkthrough");
    for (long i = 0; i < walk->count && !failed; i++) {
        const Event *event = &walk->events[i];
        walkthrough_follow(&place, walk, event);
        if (!is_told(&place, event))
            continue;
        cJSON *object = walkthrough_event_json(walk, &place, event, &failed);
        expected->events[expected->count++] = (ExpectedEvent){event->kind, walkthrough_hit_number(&place), object};
        if (!failed)
            put_more(object, walk, &place, event, &failed);
        if (!failed)
            read_numbers(object);
    }
    if (!failed)
        return true;
    expected_free(expected);
    return error_memory(error, "a walkthrough");
}

void expected_free(Expected *expected)
{
    for (int i = 0; i < expected->count; i++)
        cJSON_Delete(expected->events[i].object);
    free(expected->events);
    *expected = (Expected){.count = 0};
}
