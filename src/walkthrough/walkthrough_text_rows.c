/* What all parts of the walkthrough as text share. */
#include "walkthrough/walkthrough_text_rows.h"

#include <math.h>

/* Six digits, and as many more as the scene is farther from the origin than it is large. */
static int place_digits(const Scene *scene)
{
    Vec3 c = scene->centre;
    double far = vec3_largest(c), size = walkthrough_scene_size(scene);
    int more = size > 0 && far > size ? (int)ceil(log10(far / size)) : 0;
    return more > 9 ? 15 : INK_DIGITS + more;
}

WalkthroughText walkthrough_text_begin(FILE *out, const Walkthrough *walk, WalkthroughStyle style, int digits)
{
    int enough = place_digits(walk->scene);
    return (WalkthroughText){.ink = {out, style.colour, style.columns > 0 ? style.columns : INK_COLUMNS},
                             .walk = walk,
                             .listener = style.listener,
                             .digits = enough > digits ? enough : digits};
}

void walkthrough_text_step(WalkthroughText *text, WalkthroughStepKind kind, const char *title)
{
    const WalkthroughPlace *place = &text->place;
    bool looks_ahead = kind == STEP_PRIMARY || kind == STEP_NEAREST;
    WalkthroughStep step = {
        .kind = kind,
        .number = ++text->step,
        .hit = walkthrough_hit_number(place) + (looks_ahead ? 1 : 0),
        .light = kind == STEP_LIGHT ? place->light->as.light.light : -1,
        .title = title,
    };
    if (text->listener)
        text->listener->begin(text->listener->user, &step);
    ink_heading(&text->ink, "Step %d. %s", step.number, title);
}

InkRow walkthrough_text_place_row(const WalkthroughText *text, InkText label, Vec3 position)
{
    return (InkRow){.label = label, .v = walkthrough_world(text->walk->scene, position), .digits = text->digits};
}
