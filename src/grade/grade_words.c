/* What grading says of a difference. */
#include "grade/grade_words.h"

#include "walkthrough/walkthrough_json_event.h"

#include <math.h>
#include <string.h>

static const cJSON *member(const cJSON *object, const char *name)
{
    return cJSON_GetObjectItemCaseSensitive(object, name);
}

InkText grade_words_value(const cJSON *value)
{
    if (cJSON_IsNumber(value))
        return ink_number(value->valuedouble, INK_DIGITS);
    if (cJSON_IsString(value))
        return ink_name(value->valuestring, 80);
    if (cJSON_IsBool(value))
        return ink_text(cJSON_IsTrue(value) ? "true" : "false");
    if (cJSON_IsObject(value))
        return ink_text("{...}");
    if (!cJSON_IsArray(value))
        return ink_text("null");
    InkText text = ink_text("(");
    for (const cJSON *item = value->child; item && strlen(text.text) < 160; item = item->next) {
        const char *end = item->next ? ", " : ")";
        bool deep = cJSON_IsArray(item) || cJSON_IsObject(item);
        text = ink_text("%s%s%s", text.text, deep ? "..." : grade_words_value(item).text, end);
    }
    return value->child ? text : ink_text("()");
}

/* The face of a hit: "floor/5", or its number. */
static InkText face_words(const cJSON *hit)
{
    const cJSON *name = member(hit, "name"), *face = member(hit, "face"), *object = member(hit, "object");
    const cJSON *number = member(hit, "face_in_object");
    if (cJSON_IsString(name))
        return ink_name(name->valuestring, 60);
    if (cJSON_IsString(face))
        return ink_name(face->valuestring, 60);
    if (cJSON_IsString(object) && cJSON_IsNumber(number))
        return ink_text("%s/%d", ink_name(object->valuestring, 50).text, number->valueint);
    return ink_text("face %s", grade_words_value(face).text);
}

InkText grade_words_event(EventKind kind, const cJSON *event)
{
    if (kind == EVENT_KIND_COUNT)
        return ink_text("nothing more");
    if (kind == EVENT_HIT) {
        const char *name = member(event, "t") ? "t" : "distance";
        return ink_text("a hit of %s, %s = %s", face_words(event).text, name,
                        grade_words_value(member(event, name)).text);
    }
    if (kind == EVENT_MISS)
        return ink_text("a miss: no face is hit");
    if (kind == EVENT_LIGHT_END) {
        const cJSON *verdict = member(event, "verdict");
        return ink_text("light %s, %s", grade_words_value(member(event, "light")).text,
                        verdict                                  ? grade_words_value(verdict).text
                        : cJSON_IsTrue(member(event, "reaches")) ? "reaches"
                                                                 : "does not reach");
    }
    if (kind == EVENT_SHADED && member(event, "contribution"))
        return ink_text("what the hit adds, %s", grade_words_value(member(event, "contribution")).text);
    return ink_text("\"%s\"", walkthrough_event_name(kind));
}

InkText grade_words_place(const Difference *difference)
{
    EventKind kind =
        difference->expected_event != EVENT_KIND_COUNT ? difference->expected_event : difference->given_event;
    InkText at = difference->hit > 0 ? ink_text("P%d", difference->hit) : ink_text("the camera");
    if (kind == EVENT_PIXEL || kind == EVENT_PATH_END)
        at = ink_text("the end");
    if (difference->kind == DIFFERENCE_VALUE)
        return ink_text("%s, \"%s\": %s", at.text, walkthrough_event_name(kind), difference->member);
    return ink_text("%s, \"%s\"", at.text, walkthrough_event_name(kind));
}

InkText grade_words_expected(const Difference *difference)
{
    return difference->kind == DIFFERENCE_VALUE ? grade_words_value(difference->expected)
                                                : grade_words_event(difference->expected_event, difference->expected);
}

InkText grade_words_given(const Difference *difference)
{
    return difference->kind == DIFFERENCE_VALUE ? grade_words_value(difference->given)
                                                : grade_words_event(difference->given_event, difference->given);
}

/* given = ratio expected, in every number; 0 where there is no such ratio. */
static double ratio_of(const cJSON *expected, const cJSON *given)
{
    if (cJSON_IsNumber(expected) && cJSON_IsNumber(given))
        return expected->valuedouble == 0 ? 0 : given->valuedouble / expected->valuedouble;
    double ratio = 0;
    const cJSON *a = cJSON_IsArray(expected) ? expected->child : NULL;
    for (const cJSON *b = cJSON_IsArray(given) ? given->child : NULL; a && b; a = a->next, b = b->next) {
        if (!cJSON_IsNumber(a) || !cJSON_IsNumber(b))
            return 0;
        if (a->valuedouble == 0 && b->valuedouble == 0)
            continue;
        double one = a->valuedouble == 0 ? 0 : b->valuedouble / a->valuedouble;
        if (one == 0 || (ratio != 0 && fabs(one - ratio) > 1e-6 * fabs(ratio)))
            return 0;
        ratio = one;
    }
    return ratio;
}

InkText grade_words_ratio(const Difference *difference)
{
    double ratio = difference->kind == DIFFERENCE_VALUE ? ratio_of(difference->expected, difference->given) : 0;
    double times = fabs(ratio) < 1 && ratio != 0 ? 1 / ratio : ratio;
    if (ratio == 0 || !isfinite(times) || fabs(times - round(times)) > 1e-5 || fabs(times) > 1000)
        return ink_text("%s", "");
    if (ratio == -1)
        return ink_text("Given is what is expected, with the sign changed.");
    if (fabs(ratio) < 1)
        return ink_text("Given is what is expected, divided by %s.", ink_number(round(times), 6).text);
    return ink_text("Given is %s times what is expected.", ink_number(round(times), 6).text);
}

const char *grade_words_read(const Difference *difference)
{
    EventKind kind =
        difference->expected_event != EVENT_KIND_COUNT ? difference->expected_event : difference->given_event;
    switch (kind) {
    case EVENT_SAMPLE:
        return "algorithm.md#1-camera-and-screen";
    case EVENT_HIT:
        return "algorithm.md#3-the-plane-hit";
    case EVENT_LIGHT:
    case EVENT_LIGHT_END:
        return "algorithm.md#6-shadows";
    case EVENT_TERMS:
    case EVENT_SHADED:
        return "algorithm.md#7-illumination";
    case EVENT_PIXEL:
        return "algorithm.md#10-colour";
    default:
        return "algorithm.md#9-reflection";
    }
}
