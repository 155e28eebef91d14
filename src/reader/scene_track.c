/* Keys of an animation: read with their places, and written as the values of a frame. */
#include "reader/scene_track.h"

#include "base/text.h"
#include "reader/scene_transform.h"
#include "scene/scene.h"
#include "json/json_edit.h"
#include "json/json_read.h"

#include <float.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { FRAME, INTERPOLATION, VALUES, MOST_MEMBERS = 6 }; /* of a key; the values that move come last */

typedef struct TrackTable {
    JsonMember members[MOST_MEMBERS];
    int count;
    const char *values; /* for messages */
} TrackTable;

#define EVERY_KEY                        \
    {.name = "frame", .required = true}, \
    {                                    \
        .name = "interpolation"          \
    }

static const TrackTable tables[TRACK_KINDS] = {
    [TRACK_CAMERA] = {{EVERY_KEY, {.name = "position"}, {.name = "look_at"}, {.name = "up"}},
                      5,
                      "\"position\", \"look_at\" and \"up\""},
    [TRACK_OBJECT] = {{EVERY_KEY, {.name = "transform"}}, 3, "\"transform\""},
    [TRACK_LIGHT] = {{EVERY_KEY, {.name = "position"}, {.name = "ambient"}, {.name = "diffuse"}, {.name = "specular"}},
                     6,
                     "\"position\", \"ambient\", \"diffuse\" and \"specular\""},
};

/* Whether a value is a colour, which has no part below 0. */
static bool is_colour(const cJSON *value)
{
    return strcmp(value->string, "ambient") == 0 || strcmp(value->string, "diffuse") == 0 ||
           strcmp(value->string, "specular") == 0;
}

/* The first child that is no comment; then the one after another child. */
static const cJSON *next_member(const cJSON *child)
{
    while (child && child->string && json_is_comment(child))
        child = child->next;
    return child;
}

/* --- Reading --- */

static bool check_axis(const Json *json, const cJSON *axis, const cJSON *first)
{
    const cJSON *a = axis->child, *b = first->child;
    for (; a && b; a = a->next, b = b->next)
        if (a->valuedouble < b->valuedouble || a->valuedouble > b->valuedouble)
            return json_fail(json, axis,
                             "must be the axis of the first key: the angle moves, and the axis does not; a turn about "
                             "another axis is a step of its own");
    return true;
}

/* A valid step and that of the first key: of one kind, and of one form. */
static bool check_step(const Json *json, const cJSON *step, const cJSON *first)
{
    const cJSON *a = next_member(step->child), *b = next_member(first->child);
    if (strcmp(a->string, b->string) != 0)
        return json_fail(json, step, "must be a step \"%s\", as in the first key", b->string);
    if (cJSON_IsArray(a) != cJSON_IsArray(b))
        return json_fail(json, a, "must be %s, as in the first key",
                         cJSON_IsArray(b) ? "a list of three numbers" : "a number");
    return !cJSON_IsObject(a) ||
           check_axis(json, cJSON_GetObjectItemCaseSensitive(a, "axis"), cJSON_GetObjectItemCaseSensitive(b, "axis"));
}

static bool check_transform(const Json *json, const cJSON *steps, const cJSON *first)
{
    Transform transform;
    if (!scene_transform_read(json, steps, &transform))
        return false;
    int count = cJSON_GetArraySize(steps), wanted = cJSON_GetArraySize(first);
    if (count != wanted)
        return json_fail(json, steps, "must have the steps of the first key: %d, not %d", wanted, count);
    const cJSON *a = steps->child, *b = first->child;
    for (; a; a = a->next, b = b->next)
        if (!check_step(json, a, b))
            return false;
    return true;
}

/* A value of a key, beside the same one of the first key. */
static bool check_value(const Json *json, const cJSON *value, const cJSON *first)
{
    Vec3 v;
    if (strcmp(value->string, "transform") == 0)
        return check_transform(json, value, first);
    return is_colour(value) ? json_vec3(json, value, 0, SCENE_MAX_COLOUR, &v)
                            : json_vec3(json, value, -DBL_MAX, DBL_MAX, &v);
}

/* The values of a key: at least one, and those that the first key has. */
static bool check_values(const Json *json, const cJSON *key, const cJSON *first, const TrackTable *table)
{
    bool any = false;
    for (int i = VALUES; i < table->count; i++) {
        const char *name = table->members[i].name;
        const cJSON *value = cJSON_GetObjectItemCaseSensitive(key, name);
        const cJSON *same = cJSON_GetObjectItemCaseSensitive(first, name);
        if (!value && same)
            return json_fail(json, key, "the key \"%s\" is missing, which the first of the list has", name);
        if (value && !same)
            return json_fail_key(json, value, "the first of the list has no \"%s\"; all or none have it", name);
        if (value && !check_value(json, value, same))
            return false;
        any = any || value;
    }
    return any || json_fail(json, key, "nothing moves; a key has one or more of %s", table->values);
}

static bool read_key(Track *track, const Json *json, const cJSON *item, bool smooth)
{
    static const char *const words[] = {"linear", "smooth"};
    const TrackTable *table = &tables[track->kind];
    JsonMember members[MOST_MEMBERS];
    int frame, how = smooth;
    memcpy(members, table->members, sizeof members);
    if (!json_members(json, item, members, table->count) ||
        !json_integer(json, members[FRAME].item, 0, TRACK_MAX_FRAMES, &frame) ||
        (members[INTERPOLATION].item && !json_choice(json, members[INTERPOLATION].item, words, 2, &how)))
        return false;
    if (track->count > 0 && frame <= track->curve[track->count - 1].frame)
        return json_fail(json, members[FRAME].item, "must be larger than the frame of the key before, which is %.0f",
                         track->curve[track->count - 1].frame);
    track->items[track->count] = item;
    track->curve[track->count++] = (CurveKey){frame, how == 1};
    return check_values(json, item, track->items[0], table);
}

bool scene_track_read(Track *track, const Json *json, const cJSON *list, bool smooth)
{
    if (!json_list(json, list))
        return false;
    size_t count = (size_t)cJSON_GetArraySize(list);
    if (count == 0)
        return json_fail(json, list, "must have a key");
    track->items = calloc(count, sizeof *track->items);
    track->curve = calloc(count, sizeof *track->curve);
    if (!track->items || !track->curve)
        return error_memory(json->error, "an animation");
    for (const cJSON *child = list->child; child; child = child->next)
        if (!read_key(track, json, child, smooth))
            return false;
    return true;
}

void scene_track_free(Track *track)
{
    free(track->items);
    free(track->curve);
    *track = (Track){.count = 0};
}

/* --- Writing --- */

TrackNumber scene_track_number(double x)
{
    TrackNumber number = {"null"}; /* JSON has no infinity */
    double back = 0;
    for (int digits = 15; isfinite(x) && digits <= 17; digits++) {
        snprintf(number.text, sizeof number.text, "%.*g", digits, x + 0.0);
        if (text_number(number.text, &back) && back >= x && back <= x)
            break;
    }
    return number;
}

/* A value is the same in the keys that have a share in it, or moves: then, of a colour, it stays at 0 or above. */
static double mix(const cJSON *const *values, CurveShares shares, bool colour)
{
    double sum = 0, first = values[0]->valuedouble;
    bool moves = false;
    for (int i = 0; i < shares.count; i++) {
        double value = values[i]->valuedouble;
        sum += shares.share[i] * value;
        moves = moves || value < first || value > first;
    }
    sum = moves ? sum : first;
    return colour ? fmax(sum, 0) : sum;
}

static void write_mixture(FILE *out, const cJSON *const *values, CurveShares shares, bool colour);

/* Lists of the same length. */
static void write_list(FILE *out, const cJSON *const *lists, CurveShares shares, bool colour)
{
    const cJSON *items[4];
    for (int k = 0; k < shares.count; k++)
        items[k] = lists[k]->child;
    for (const char *before = "["; items[0]; before = ", ") {
        fputs(before, out);
        write_mixture(out, items, shares, colour);
        for (int k = 0; k < shares.count; k++)
            items[k] = items[k]->next;
    }
    fputs(lists[0]->child ? "]" : "[]", out);
}

/* Objects of the same keys, in any order; comments are left out. */
static void write_object(FILE *out, const cJSON *const *objects, CurveShares shares, bool colour)
{
    const cJSON *items[4], *member = next_member(objects[0]->child);
    for (const char *before = "{"; member; member = next_member(member->next), before = ",") {
        fprintf(out, "%s \"%s\": ", before, member->string);
        for (int k = 0; k < shares.count; k++)
            items[k] = cJSON_GetObjectItemCaseSensitive(objects[k], member->string);
        write_mixture(out, items, shares, colour);
    }
    fputs(" }", out);
}

/* Writes a mixture of values that differ in their numbers only. */
static void write_mixture(FILE *out, const cJSON *const *values, CurveShares shares, bool colour)
{
    if (cJSON_IsArray(values[0]))
        write_list(out, values, shares, colour);
    else if (cJSON_IsObject(values[0]))
        write_object(out, values, shares, colour);
    else
        fputs(scene_track_number(mix(values, shares, colour)).text, out);
}

char *scene_track_put(char *text, const char *path, const char *value, Error *error)
{
    char *edited = json_edit(text, path, value, error);
    free(text);
    if (!edited)
        error_memory(error, "a frame"); /* unless another fault is told */
    return edited;
}

/* Puts the value that the keys call `name` into the text. */
static char *apply_value(const Track *track, const char *name, CurveShares shares, char *text, Error *error)
{
    const cJSON *values[4];
    char path[sizeof track->target + 32], *value = NULL;
    size_t size = 0;
    for (int k = 0; k < shares.count; k++)
        values[k] = cJSON_GetObjectItemCaseSensitive(track->items[shares.first + k], name);
    FILE *out = open_memstream(&value, &size);
    if (out)
        write_mixture(out, values, shares, is_colour(values[0]));
    snprintf(path, sizeof path, "%s.%s", track->target, name);
    if (out && fclose(out) == 0)
        text = scene_track_put(text, path, value, error);
    else {
        free(text);
        text = NULL;
        error_memory(error, "a frame");
    }
    free(value);
    return text;
}

char *scene_track_apply(const Track *track, int frame, char *text, Error *error)
{
    const TrackTable *table = &tables[track->kind];
    CurveShares shares = scene_curve_shares(track->curve, track->count, frame);
    for (int i = VALUES; i < table->count && text; i++)
        if (cJSON_GetObjectItemCaseSensitive(track->items[0], table->members[i].name))
            text = apply_value(track, table->members[i].name, shares, text, error);
    return text;
}
