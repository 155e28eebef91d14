/* Compares a walkthrough that was given with what is expected, event by event and member by member. Members that only
 * one of them has say nothing. */
#include "grade/difference.h"

#include "json/json_read.h"

#include <math.h>
#include <string.h>

/* What is being compared, and how. */
typedef struct Comparison {
    const Given *given;
    Tolerance tolerance;
    Units units;
    Difference *difference;
    bool failed;
} Comparison;

/* --- Values --- */

static bool is_near(const Comparison *comparison, double expected, double given, double size)
{
    return fabs(given - expected) <= comparison->tolerance.absolute + comparison->tolerance.relative * size ||
           given == expected;
}

/* The largest number of a list, without its sign. */
static double size_of(const cJSON *list)
{
    double size = 0;
    for (const cJSON *item = list->child; item; item = item->next)
        size = cJSON_IsNumber(item) ? fmax(size, fabs(item->valuedouble)) : size;
    return size;
}

static bool fail(Comparison *comparison, const cJSON *given, const char *wanted)
{
    comparison->failed = true;
    return json_fail_type(&comparison->given->json, given, wanted);
}

static bool same(Comparison *comparison, const cJSON *expected, const cJSON *given, double unit);

/* A list of numbers is measured by its largest: a direction's smallest part is as exact as its largest one. */
static bool same_list(Comparison *comparison, const cJSON *expected, const cJSON *given, double unit)
{
    if (!cJSON_IsArray(given))
        return fail(comparison, given, "a list");
    double size = unit * size_of(expected);
    const cJSON *a = expected->child, *b = given->child;
    for (; a && b; a = a->next, b = b->next) {
        bool numbers = cJSON_IsNumber(a) && cJSON_IsNumber(b);
        if (numbers ? !is_near(comparison, unit * a->valuedouble, b->valuedouble, size) : !same(comparison, a, b, unit))
            return false;
    }
    return !a && !b;
}

static bool same_object(Comparison *comparison, const cJSON *expected, const cJSON *given, double unit)
{
    if (!cJSON_IsObject(given))
        return fail(comparison, given, "an object");
    for (const cJSON *a = expected->child; a; a = a->next) {
        const cJSON *b = cJSON_GetObjectItemCaseSensitive(given, a->string);
        if (b && !same(comparison, a, b, unit))
            return false;
    }
    return true;
}

static bool same(Comparison *comparison, const cJSON *expected, const cJSON *given, double unit)
{
    if (cJSON_IsNull(expected))
        return true; /* beyond all doubles: nothing to compare with */
    if (cJSON_IsArray(expected))
        return same_list(comparison, expected, given, unit);
    if (cJSON_IsObject(expected))
        return same_object(comparison, expected, given, unit);
    if (cJSON_IsBool(expected))
        return cJSON_IsBool(given) ? cJSON_IsTrue(expected) == cJSON_IsTrue(given)
                                   : fail(comparison, given, "true or false");
    if (cJSON_IsString(expected))
        return cJSON_IsString(given) ? strcmp(expected->valuestring, given->valuestring) == 0
                                     : fail(comparison, given, "a string");
    if (cJSON_IsNull(given))
        return false; /* infinity, or no number: our own writer says null */
    return cJSON_IsNumber(given) ? is_near(comparison, unit * expected->valuedouble, given->valuedouble,
                                           unit * fabs(expected->valuedouble))
                                 : fail(comparison, given, "a number");
}

/* Three bytes. One that is nearly halfway between two may be either. */
static bool same_bytes(Comparison *comparison, const cJSON *object, const cJSON *expected, const cJSON *given)
{
    const cJSON *scaled = cJSON_GetObjectItemCaseSensitive(object, "scaled");
    const cJSON *clamped = cJSON_GetObjectItemCaseSensitive(object, "clamped");
    if (comparison->units.byte != 1)
        return same_list(comparison, clamped, given, 255 * comparison->units.byte);
    if (!cJSON_IsArray(given))
        return fail(comparison, given, "a list");
    const cJSON *a = expected->child, *b = given->child, *s = scaled->child;
    for (; a && b && s; a = a->next, b = b->next, s = s->next) {
        double off = 255 * (comparison->tolerance.absolute + comparison->tolerance.relative);
        double lower = floor(s->valuedouble - off), upper = floor(s->valuedouble + off);
        if (!cJSON_IsNumber(b))
            return fail(comparison, b, "a number");
        bool halfway = lower != upper && (b->valuedouble == lower || b->valuedouble == upper);
        if (b->valuedouble != a->valuedouble && !(halfway && fabs(a->valuedouble - b->valuedouble) <= 1))
            return false;
    }
    return !a && !b;
}

/* --- Members --- */

/* How a tracer shifts a point is its own affair, and so is the exact sign of what is nearly 0. Which of several faces
 * in the way was found first is a matter of the tree. A wrong exponent shows in the highlight. */
static bool is_free(EventKind kind, const char *name)
{
    static const char *const names[] = {"event", "shift",      "shifted", "shadow_origin", "origin",
                                        "told",  "edge_signs", "side",    "exponent"};
    static const char *const of_blocker[] = {"face", "object", "part", "face_in_object", "piece", "pieces"};
    for (size_t i = 0; i < sizeof names / sizeof *names; i++)
        if (strcmp(name, names[i]) == 0)
            return true;
    for (size_t i = 0; i < sizeof of_blocker / sizeof *of_blocker && kind == EVENT_LIGHT_END; i++)
        if (strcmp(name, of_blocker[i]) == 0)
            return true;
    return false;
}

static bool is_colour(const char *name)
{
    static const char *const names[] = {"contribution", "illumination", "total", "colour",  "ambient",
                                        "diffuse",      "specular",     "sum",   "average", "clamped"};
    for (size_t i = 0; i < sizeof names / sizeof *names; i++)
        if (strcmp(name, names[i]) == 0)
            return true;
    return false;
}

static bool same_member(Comparison *comparison, const ExpectedEvent *event, const cJSON *expected, const cJSON *given)
{
    if (strcmp(expected->string, "rgb") == 0)
        return same_bytes(comparison, event->object, expected, given);
    return same(comparison, expected, given, is_colour(expected->string) ? comparison->units.colour : 1);
}

static bool found(Difference *difference, const char *member, const cJSON *expected, const cJSON *given)
{
    difference->kind = DIFFERENCE_VALUE;
    difference->member = member;
    difference->expected = expected;
    difference->given = given;
    return false;
}

/* "face" may be a name, and "reaches" stands for a verdict. */
static bool same_special(Comparison *comparison, const ExpectedEvent *event, const cJSON *given)
{
    Difference *difference = comparison->difference;
    const cJSON *face = cJSON_GetObjectItemCaseSensitive(given, "face");
    const cJSON *name = cJSON_GetObjectItemCaseSensitive(event->object, "name");
    if (event->kind == EVENT_HIT && cJSON_IsString(face)) {
        difference->members++;
        if (strcmp(face->valuestring, name->valuestring) != 0)
            return found(difference, "face", name, face);
    }
    const cJSON *reaches = cJSON_GetObjectItemCaseSensitive(given, "reaches");
    const cJSON *verdict = cJSON_GetObjectItemCaseSensitive(event->object, "verdict");
    if (event->kind == EVENT_LIGHT_END && cJSON_IsBool(reaches)) {
        difference->members++;
        if (cJSON_IsTrue(reaches) != (strcmp(verdict->valuestring, "reaches") == 0))
            return found(difference, "reaches", verdict, reaches);
    }
    return true;
}

/* False at the first member that differs, or that has a wrong type. */
static bool same_event(Comparison *comparison, const ExpectedEvent *event, const cJSON *given)
{
    if (!same_special(comparison, event, given))
        return false;
    for (const cJSON *expected = event->object->child; expected; expected = expected->next) {
        const cJSON *value = cJSON_GetObjectItemCaseSensitive(given, expected->string);
        bool named = event->kind == EVENT_HIT && strcmp(expected->string, "face") == 0 && cJSON_IsString(value);
        if (!value || named || is_free(event->kind, expected->string) || strcmp(expected->string, "name") == 0)
            continue;
        if (!same_member(comparison, event, expected, value))
            return found(comparison->difference, expected->string, expected, value);
        comparison->difference->members++;
    }
    return true;
}

/* --- Events --- */

/* The next event that is asked for. */
static const ExpectedEvent *next_asked(const Expected *expected, int *at, const Given *given)
{
    for (; *at < expected->count; ++*at)
        if (expected->events[*at].kind == EVENT_HIT || given->kinds[expected->events[*at].kind])
            return &expected->events[(*at)++];
    return NULL;
}

/* The walkthroughs part in what happens next. Either may be NULL. */
static void part(Difference *difference, const ExpectedEvent *expected, const GivenEvent *given)
{
    difference->kind = !given ? DIFFERENCE_MISSING : !expected ? DIFFERENCE_SURPLUS : DIFFERENCE_EVENT;
    difference->expected = expected ? expected->object : NULL;
    difference->given = given ? given->object : NULL;
}

bool difference_find(Difference *difference, const Expected *expected, const Given *given, Tolerance tolerance,
                     Units units)
{
    Comparison comparison = {given, tolerance, units, difference, false};
    *difference = (Difference){.kind = DIFFERENCE_NONE};
    for (int i = 0, at = 0;; i++) {
        const ExpectedEvent *ours = next_asked(expected, &at, given);
        const GivenEvent *theirs = i < given->count ? &given->events[i] : NULL;
        if (!ours && !theirs)
            return true;
        difference->hit = ours ? ours->hit : difference->hit;
        difference->expected_event = ours ? ours->kind : EVENT_KIND_COUNT;
        difference->given_event = theirs ? theirs->kind : EVENT_KIND_COUNT;
        difference->object = theirs ? theirs->object : NULL;
        if (!ours || !theirs || ours->kind != theirs->kind) {
            part(difference, ours, theirs);
            return true;
        }
        if (!same_event(&comparison, ours, theirs->object))
            return !comparison.failed;
        difference->events++;
        difference->members++;
    }
}
