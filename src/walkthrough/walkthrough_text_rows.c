/* What all parts of the walkthrough as text share. */
#include "walkthrough/walkthrough_text_rows.h"

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
