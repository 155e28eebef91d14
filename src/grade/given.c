/* Reads a walkthrough that some program wrote. Two shapes are taken: a list of events, or a summary with a list of
 * hits. A summary's hit becomes the events that it stands for: the hit, its lights, what it adds. */
#include "grade/given.h"

#include "base/suggest.h"
#include "base/text.h"
#include "walkthrough/walkthrough.h"
#include "walkthrough/walkthrough_json_event.h"
#include "json/json_read.h"

#include <stdlib.h>
#include <string.h>

enum { PIXEL_MOST = SCENE_MAX_PIXELS - 1, SAMPLE_MOST = 255 };

static const cJSON *member(const cJSON *object, const char *name)
{
    return cJSON_GetObjectItemCaseSensitive(object, name);
}

static bool add(Given *given, EventKind kind, const cJSON *object)
{
    if (given->count == given->capacity) {
        int capacity = given->capacity ? 2 * given->capacity : 32;
        GivenEvent *events = realloc(given->events, (size_t)capacity * sizeof *given->events);
        if (!events)
            return error_memory(given->json.error, "a walkthrough");
        given->events = events;
        given->capacity = capacity;
    }
    given->events[given->count++] = (GivenEvent){kind, object};
    given->kinds[kind] = true;
    return true;
}

/* --- What each event must have --- */

static bool has(const cJSON *object, const char *name)
{
    return member(object, name) != NULL;
}

/* A face is a number in the file, a name like "floor/5", or the object's name and the number in it. */
static bool check_face(const Json *json, const cJSON *object)
{
    const cJSON *face = member(object, "face"), *name = member(object, "object");
    const char *text;
    int number;
    if (!face && !name)
        return json_fail(json, object, "needs \"face\": its number in the file, or a name such as \"floor/5\"");
    if (face && !cJSON_IsString(face) && !cJSON_IsNumber(face))
        return json_fail_type(json, face, "a face's number, or a name such as \"floor/5\"");
    if (face && cJSON_IsNumber(face) && !json_integer(json, face, 0, 2147483647, &number))
        return false;
    if (face)
        return true;
    const cJSON *in_object = member(object, "face_in_object");
    return json_string(json, name, &text) &&
           (in_object ? json_integer(json, in_object, 0, 2147483647, &number)
                      : json_fail(json, object, "needs \"face_in_object\", the face's number in its object"));
}

static bool check_light_end(const Json *json, const cJSON *object)
{
    const cJSON *light = member(object, "light"), *verdict = member(object, "verdict");
    const cJSON *reaches = member(object, "reaches");
    int number;
    if (!light)
        return json_fail(json, object, "needs \"light\", its number from 0");
    if (!json_integer(json, light, 0, 2147483647, &number))
        return false;
    if (!verdict && !reaches)
        return json_fail(json, object,
                         "needs \"verdict\": \"reaches\", \"blocked\" or \"behind face\"; or "
                         "\"reaches\": true or false");
    if (reaches && !cJSON_IsBool(reaches))
        return json_fail_type(json, reaches, "true or false");
    return !verdict || json_choice(json, verdict, walkthrough_light_verdicts, 3, &number);
}

static bool check_event(const Json *json, EventKind kind, const cJSON *object)
{
    switch (kind) {
    case EVENT_HIT:
        return check_face(json, object) &&
               (has(object, "t") || has(object, "distance") || has(object, "point") ||
                json_fail(json, object, "needs \"t\", along R; or \"distance\"; or \"point\""));
    case EVENT_LIGHT_END:
        return check_light_end(json, object);
    case EVENT_SHADED:
        return has(object, "contribution") || has(object, "illumination") ||
               json_fail(json, object, "needs \"contribution\", what the hit adds; or \"illumination\"");
    case EVENT_LIGHT:
    case EVENT_TERMS:
        return has(object, "light") || json_fail(json, object, "needs \"light\", its number from 0");
    default:
        return true;
    }
}

static bool take(Given *given, EventKind kind, const cJSON *object)
{
    return check_event(&given->json, kind, object) && add(given, kind, object);
}

/* --- A list of events --- */

/* Its kind; EVENT_KIND_COUNT after a failure. */
static EventKind kind_of(const Json *json, const cJSON *event)
{
    const cJSON *name = member(event, "event");
    const char *known[EVENT_KIND_COUNT + 1] = {NULL}, *word;
    if (!cJSON_IsObject(event))
        json_fail_type(json, event, "an object");
    else if (!name)
        json_fail(json, event, "needs \"event\", its kind, such as \"hit\"");
    else if (json_string(json, name, &word)) {
        for (int k = 0; k < EVENT_KIND_COUNT; k++) {
            known[k] = walkthrough_event_name((EventKind)k);
            if (strcmp(word, known[k]) == 0)
                return (EventKind)k;
        }
        const char *nearest = suggest_word(word, known);
        if (nearest)
            json_fail(json, name, "there is no event %s; did you mean \"%s\"?", text_quote(word).text, nearest);
        else
            json_fail(json, name, "there is no event %s; docs/walkthrough.schema.json lists them",
                      text_quote(word).text);
    }
    return EVENT_KIND_COUNT;
}

/* Which faces and nodes were tested is a matter of the tree, and how a pixel is sampled one of the tracer. */
static bool is_compared(EventKind kind)
{
    return kind != EVENT_TALLY && kind != EVENT_FACE && kind != EVENT_OCCLUDER && kind != EVENT_NODE &&
           kind != EVENT_ADAPTIVE;
}

/* Of several samples one is told; the others have a beginning and an end. */
static bool read_events(Given *given, const cJSON *list)
{
    bool told = true;
    if (!json_list(&given->json, list))
        return false;
    for (const cJSON *event = list->child; event; event = event->next) {
        EventKind kind = kind_of(&given->json, event);
        if (kind == EVENT_KIND_COUNT)
            return false;
        if (kind == EVENT_SAMPLE)
            told = !cJSON_IsFalse(member(event, "told"));
        if (is_compared(kind) && (told || kind == EVENT_PIXEL) && !take(given, kind, event))
            return false;
    }
    return true;
}

/* --- A summary --- */

static bool read_hit(Given *given, const cJSON *hit)
{
    const cJSON *lights = member(hit, "lights");
    if (!cJSON_IsObject(hit))
        return json_fail_type(&given->json, hit, "an object");
    if (!take(given, EVENT_HIT, hit) || (lights && !json_list(&given->json, lights)))
        return false;
    for (const cJSON *light = lights ? lights->child : NULL; light; light = light->next)
        if (cJSON_IsObject(light) ? !take(given, EVENT_LIGHT_END, light)
                                  : !json_fail_type(&given->json, light, "an object"))
            return false;
    bool shaded = has(hit, "contribution") || has(hit, "illumination");
    return !shaded || add(given, EVENT_SHADED, hit);
}

static bool read_summary(Given *given, const cJSON *summary)
{
    if (!cJSON_IsObject(summary))
        return json_fail_type(&given->json, summary, "an object");
    const cJSON *hits = member(summary, "hits"), *background = member(summary, "background");
    if (!hits)
        return json_fail(&given->json, summary, "needs \"hits\", the list of the points that the path meets");
    if (!json_list(&given->json, hits))
        return false;
    for (const cJSON *hit = hits->child; hit; hit = hit->next)
        if (!read_hit(given, hit))
            return false;
    if (background && !cJSON_IsObject(background))
        return json_fail_type(&given->json, background, "an object");
    if (background && !add(given, EVENT_MISS, background))
        return false;
    return (!has(summary, "colour") || add(given, EVENT_PATH_END, summary)) &&
           (!has(summary, "rgb") || add(given, EVENT_PIXEL, summary));
}

/* --- All of it --- */

static bool read_pixel(Given *given, const cJSON *pixel)
{
    const Json *json = &given->json;
    const cJSON *column = member(pixel, "column"), *row = member(pixel, "row");
    const cJSON *i = member(pixel, "i"), *j = member(pixel, "j");
    if (!cJSON_IsObject(pixel))
        return json_fail_type(json, pixel, "an object");
    if (!column || !row)
        return json_fail(json, pixel, "needs \"column\" and \"row\", counted from 0 at the top left");
    given->has_pixel = true;
    return json_integer(json, column, 0, PIXEL_MOST, &given->column) &&
           json_integer(json, row, 0, PIXEL_MOST, &given->row) &&
           (!i || json_integer(json, i, 0, SAMPLE_MOST, &given->i)) &&
           (!j || json_integer(json, j, 0, SAMPLE_MOST, &given->j));
}

static bool read_document(Given *given)
{
    const Json *json = &given->json;
    const cJSON *root = json->root;
    if (cJSON_IsArray(root))
        return json_fail(json, root, "is a list; a walkthrough is one object, that of one pixel");
    if (!cJSON_IsObject(root))
        return json_fail_type(json, root, "an object, a walkthrough");
    const cJSON *version = member(root, "walkthrough"), *pixel = member(root, "pixel");
    const cJSON *events = member(root, "events"), *summary = member(root, "summary");
    int number;
    if (version && !json_integer(json, version, 1, 1, &number))
        return false;
    if (pixel && !read_pixel(given, pixel))
        return false;
    if (!events && !summary)
        return json_fail(json, root, "needs \"summary\" with its \"hits\", or \"events\"");
    return events ? read_events(given, events) : read_summary(given, summary);
}

static bool finish(Given *given, bool loaded)
{
    if (loaded && read_document(given))
        return true;
    given_free(given);
    return false;
}

bool given_load(Given *given, const char *path, Error *error)
{
    *given = (Given){.count = 0};
    return finish(given, json_load(&given->json, path, error));
}

bool given_parse(Given *given, const char *name, const char *text, long length, Error *error)
{
    *given = (Given){.count = 0};
    return finish(given, json_parse(&given->json, name, text, length, error));
}

void given_free(Given *given)
{
    free(given->events);
    json_free(&given->json);
    *given = (Given){.count = 0};
}
