/* Which lights reach a hit, in a line. */
#include "walkthrough/walkthrough_summary_lights.h"

#include "walkthrough/walkthrough_words.h"

#include <string.h>

enum { LIGHTS_LISTED = 4, WHOLE_NAME = 40, SHORT_NAME = 18, LEAST_NAME = 12 };

/* "light 2", "lights 0, 2", "12 lights": those with the verdict and, if it is not -1, the blocker. */
static InkText lights_of(const Summary *summary, const SummaryHit *hit, LightVerdict verdict, int blocker, int *count)
{
    InkText list = {""};
    *count = 0;
    for (int i = 0; i < summary->walk->scene->light_count; i++) {
        const SummaryLight *light = &hit->lights[i];
        if (light->verdict != verdict || (blocker >= 0 && light->blocker != blocker))
            continue;
        if (++*count <= LIGHTS_LISTED)
            list = ink_text("%s%s%d", list.text, *count > 1 ? ", " : "", light->light);
    }
    if (*count > LIGHTS_LISTED)
        return ink_text("%d lights", *count);
    return ink_text("light%s %s", *count > 1 ? "s" : "", list.text);
}

static InkText joined(InkText words, InkText more)
{
    return ink_text("%s%s%s", words.text, words.text[0] ? "; " : "", more.text);
}

/* Whether no light before this one is blocked by the same face. */
static bool is_first_blocked(const SummaryHit *hit, int light)
{
    for (int i = 0; i < light; i++)
        if (hit->lights[i].verdict == LIGHT_BLOCKED && hit->lights[i].blocker == hit->lights[light].blocker)
            return false;
    return hit->lights[light].verdict == LIGHT_BLOCKED;
}

/* "lights 0, 2 reach it; light 1 is behind it; light 3 is blocked by ceiling/3". With `brief`, one blocker is named.
 * A name has at most so many columns. */
static InkText light_words(const Summary *summary, const SummaryHit *hit, bool brief, int name_columns)
{
    const Scene *scene = summary->walk->scene;
    InkText words = {""};
    int count, first = -1;
    InkText which = lights_of(summary, hit, LIGHT_REACHES, -1, &count);
    if (count > 0)
        words = ink_text("%s reach%s it", which.text, count == 1 ? "es" : "");
    which = lights_of(summary, hit, LIGHT_BEHIND_FACE, -1, &count);
    if (count > 0)
        words = joined(words, ink_text("%s %s behind the face", which.text, count == 1 ? "is" : "are"));
    for (int i = 0; i < scene->light_count; i++) {
        if (!is_first_blocked(hit, i) || (brief && first >= 0))
            continue;
        first = i;
        which = lights_of(summary, hit, LIGHT_BLOCKED, brief ? -1 : hit->lights[i].blocker, &count);
        words = joined(words, ink_text("%s blocked by %s%s", which.text,
                                       walkthrough_face_words(scene, hit->lights[i].blocker, name_columns).text,
                                       brief && count > 1 ? " and others" : ""));
    }
    return scene->light_count > 0 ? words : ink_text("the scene has no light");
}

/* "light 2 reaches it; light 1 behind; lights 0, 3 blocked by ceiling/3...". */
static InkText terse_words(const Summary *summary, const SummaryHit *hit, int name_columns)
{
    InkText words = {""};
    int count;
    InkText which = lights_of(summary, hit, LIGHT_REACHES, -1, &count);
    if (count > 0)
        words = ink_text("%s reach%s it", which.text, count == 1 ? "es" : "");
    which = lights_of(summary, hit, LIGHT_BEHIND_FACE, -1, &count);
    if (count > 0)
        words = joined(words, ink_text("%s behind", which.text));
    which = lights_of(summary, hit, LIGHT_BLOCKED, -1, &count);
    for (int i = 0; i < summary->walk->scene->light_count && count > 0; i++)
        if (hit->lights[i].verdict == LIGHT_BLOCKED)
            return joined(
                words, ink_text("%s blocked by %s%s", which.text,
                                walkthrough_face_words(summary->walk->scene, hit->lights[i].blocker, name_columns).text,
                                count > 1 ? "..." : ""));
    return words;
}

/* Whether nothing was cut off and the columns hold it. */
static bool fits(InkText words, int columns)
{
    return strlen(words.text) + 1 < sizeof words.text && ink_width(words.text) <= columns;
}

InkText walkthrough_summary_lights(const Summary *summary, const SummaryHit *hit, int columns)
{
    InkText words = light_words(summary, hit, false, WHOLE_NAME);
    if (!fits(words, columns))
        words = light_words(summary, hit, false, SHORT_NAME);
    if (!fits(words, columns))
        words = light_words(summary, hit, true, SHORT_NAME);
    if (!fits(words, columns))
        words = terse_words(summary, hit, WHOLE_NAME);
    return fits(words, columns) ? words : terse_words(summary, hit, LEAST_NAME);
}

InkText walkthrough_summary_light_count(const Summary *summary, const SummaryHit *hit)
{
    int reaching;
    lights_of(summary, hit, LIGHT_REACHES, -1, &reaching);
    return ink_text("%d of %d lights reach it", reaching, summary->walk->scene->light_count);
}
