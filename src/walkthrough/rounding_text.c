/* The walkthrough with the textbook's numbers, and at each step what is exactly so. */
#include "walkthrough/rounding_rows.h"

#include "walkthrough/walkthrough_text.h"
#include "walkthrough/walkthrough_text_head.h"

typedef struct RoundingText {
    WalkthroughText steps; /* the textbook's */
    RoundingRows rows;
    WalkthroughPlace exact; /* where the exact walkthrough is, as long as both are at the same face */
    long next;              /* its next event */
    bool together;
} RoundingText;

/* --- The summary --- */

static void print_parting_place(const RoundingRows *rows, RoundingPart part)
{
    if (part.hit < 0)
        ink_line(&rows->ink, "    Both meet the same faces and agree on every light: they part in points only.");
    else if (part.light < 0)
        ink_line(&rows->ink, "    They part at P%d, where they do not find the same face.", part.hit + 1);
    else
        ink_line(&rows->ink, "    They part at P%d, in what they say of light %d.", part.hit + 1, part.light);
    if (part.hit >= 0)
        rounding_part_rows(rows, part);
}

/* The place where they part; where there is none, the first hit. */
static void print_place(const RoundingRows *rows, RoundingPart part)
{
    fputc('\n', rows->ink.out);
    rounding_hit_rows(rows, part.hit < 0 ? 0 : part.hit, true);
    if (part.light >= 0)
        rounding_light_rows(rows, part.hit, part.light);
    fputc('\n', rows->ink.out);
}

static void print_summary(const RoundingText *text, const Walkthrough *walk)
{
    const Rounding *rounding = text->rows.rounding;
    const Ink *ink = &text->rows.ink;
    RoundingPart part = rounding_part(rounding);
    fprintf(ink->out, "%sPixel (%d, %d) of %s%s\n", ink_colour(ink, 'b'), walk->request.column, walk->request.row,
            ink_name(walk->scene_name, 60).text, ink_colour(ink, '0'));
    ink_line(ink, "    textbook arithmetic in %s, points shifted by %s,\tbeside the exact one",
             render_precisions[rounding->precision], ink_number((double)rounding->shift, 6).text);
    print_parting_place(&text->rows, part);
    print_place(&text->rows, part);
    rounding_pixel_row(&text->rows);
}

/* --- The steps --- */

/* The exact event of that kind which follows, or NULL. */
static const Event *exact_event(RoundingText *text, EventKind kind)
{
    const Walkthrough *walk = text->rows.rounding->walk;
    while (text->next < walk->count) {
        const Event *event = &walk->events[text->next++];
        walkthrough_follow(&text->exact, walk, event);
        if (text->exact.told && event->kind == kind)
            return event;
    }
    return NULL;
}

static void print_parting(const RoundingText *text, RoundingPart part)
{
    ink_line(&text->rows.ink, "\n    Here the two part.");
    rounding_part_rows(&text->rows, part);
}

/* Of the hit, or the miss, of that number. */
static void compare_hit(RoundingText *text, int k)
{
    text->together = rounding_same_face(text->rows.rounding, k);
    if (!text->together) {
        print_parting(text, (RoundingPart){k, -1});
    } else if (text->rows.rounding->exact.hits[k].face >= 0) {
        fputc('\n', text->rows.ink.out);
        rounding_hit_rows(&text->rows, k, false);
    }
}

static void compare_light(const RoundingText *text, int k, const Event *event)
{
    const Rounding *rounding = text->rows.rounding;
    int light = event->as.light_end.light;
    bool reaches = event->as.light_end.verdict == LIGHT_REACHES;
    if (!reaches)
        fputc('\n', text->rows.ink.out);
    rounding_light_rows(&text->rows, k, light);
    if (!rounding_same_verdict(rounding, k, light))
        print_parting(text, (RoundingPart){k, light});
    if (reaches || rounding->walk->scene->shading.shadow == SHADOW_AMBIENT)
        fputc('\n', text->rows.ink.out);
}

static void compare_vectors(const RoundingText *text, const char *name, Vec3 textbook, Vec3 exact)
{
    fputc('\n', text->rows.ink.out);
    rounding_vector_rows(&text->rows, name, textbook, exact);
}

static void compare_mirror(RoundingText *text, const Event *event)
{
    const Event *exact = exact_event(text, EVENT_REFLECTED);
    text->together = exact != NULL;
    if (exact)
        compare_vectors(text, "R'", event->as.reflected.direction, exact->as.reflected.direction);
    else
        ink_line(&text->rows.ink, "\n    Exactly the path ends here.");
}

/* What is exactly so at the event, which the text has told. */
static void compare(RoundingText *text, const Event *event)
{
    int k = walkthrough_hit_number(&text->steps.place) - 1;
    const Event *exact;
    switch (event->kind) {
    case EVENT_SAMPLE:
        if ((exact = exact_event(text, EVENT_SAMPLE)) != NULL)
            compare_vectors(text, "R", event->as.sample.r, exact->as.sample.r);
        break;
    case EVENT_HIT:
        compare_hit(text, k);
        break;
    case EVENT_MISS:
        compare_hit(text, k + 1);
        break;
    case EVENT_LIGHT_END:
        compare_light(text, k, event);
        break;
    case EVENT_SHADED:
        if ((exact = exact_event(text, EVENT_SHADED)) != NULL)
            compare_vectors(text, "adds", event->as.shaded.contribution, exact->as.shaded.contribution);
        break;
    case EVENT_REFLECTED:
        compare_mirror(text, event);
        break;
    default:
        break;
    }
}

/* At the end of the path. */
static void compare_sums(const RoundingText *text)
{
    const RoundingPath *textbook = &text->rows.rounding->textbook, *exact = &text->rows.rounding->exact;
    compare_vectors(text, "sum", textbook->colour, exact->colour);
    if (text->together && textbook->count < exact->count)
        ink_line(&text->rows.ink, "\n    Exactly the path goes on from P%d.", textbook->count);
}

static void print_step(RoundingText *text, const Event *event)
{
    WalkthroughText *steps = &text->steps;
    bool together = text->together;
    walkthrough_text_event(steps, event);
    if (together)
        compare(text, event);
    if (together && !text->together)
        ink_line(&steps->ink, "\n    From here on the two paths differ. What follows is the textbook's.");
    if (event->kind == EVENT_PATH_END)
        compare_sums(text);
    walkthrough_text_search_begin(steps, event);
}

static void print_steps(RoundingText *text, const Walkthrough *told)
{
    WalkthroughText *steps = &text->steps;
    walkthrough_text_head(steps);
    for (long i = 0; i < told->count; i++) {
        const Event *event = &told->events[i];
        walkthrough_follow(&steps->place, told, event);
        if (event->kind == EVENT_PIXEL)
            walkthrough_text_event(steps, event);
        else if (steps->place.told)
            print_step(text, event);
    }
    const unsigned char *exact = text->rows.rounding->exact.rgb;
    ink_line(&steps->ink, "Exactly it is (%d, %d, %d).", exact[0], exact[1], exact[2]);
}

void rounding_write_text(FILE *out, const Rounding *rounding, WalkthroughStyle style)
{
    RoundingText text = {.together = true};
    text.steps = walkthrough_text_begin(out, &rounding->told, style, 9);
    text.steps.rounding = rounding;
    text.rows = (RoundingRows){text.steps.ink, rounding};
    print_summary(&text, rounding->walk);
    if (style.parts != WALKTHROUGH_SUMMARY)
        print_steps(&text, &rounding->told);
}
