/* The textbook's path beside the exact one, as text. */
#include "walkthrough/rounding_words.h"

typedef struct RoundingText {
    Ink ink;
    const Rounding *rounding;
    int digits; /* of t and of points: as many as the precision tells apart */
    int step;   /* the number of the next one, as the exact walkthrough counts */
} RoundingText;

static void print_part(const RoundingText *text, RoundingPart part)
{
    ink_hanging(&text->ink, 4, "    textbook: %s;", rounding_textbook_words(text->rounding, part).text);
    ink_hanging(&text->ink, 4, "    exactly: %s.", rounding_exact_words(text->rounding, part).text);
}

/* --- A hit --- */

static InkText face_at(const RoundingText *text, const RoundingHit *hit)
{
    if (hit->face < 0)
        return ink_text("no face: the background shines in");
    InkText name = rounding_face(text->rounding, hit->face);
    return ink_text("%s at t = %s", name.text, ink_number(hit->t, text->digits).text);
}

static InkText above_words(double above)
{
    if (above == 0)
        return ink_text("in its face's plane");
    return ink_text("%s %s its face", rounding_size(above).text, above < 0 ? "below" : "above");
}

static InkText apart(double difference)
{
    return difference == 0 ? ink_text("the same") : ink_text("%s apart", rounding_size(difference).text);
}

static InkText world(const RoundingText *text, Vec3 point)
{
    return ink_vector(walkthrough_world(text->rounding->walk->scene, point), text->digits);
}

static void print_hit(const RoundingText *text, int k)
{
    const Ink *ink = &text->ink;
    const RoundingHit *found = &text->rounding->textbook.hits[k], *right = &text->rounding->exact.hits[k];
    bool same = rounding_same_face(text->rounding, k);
    InkText t_apart =
        same && right->face >= 0 ? ink_text(",\t%s", apart(found->t - right->t).text) : ink_text("%s", "");
    ink_line(ink, "    textbook  %s", face_at(text, found).text);
    ink_line(ink, "    exact     %s%s", face_at(text, right).text, t_apart.text);
    if (!same || right->face < 0)
        return;
    fputc('\n', ink->out);
    ink_line(ink, "    P%d   textbook  %s", k + 1, world(text, found->point).text);
    ink_line(ink, "         exact     %s,\t%s", world(text, right->point).text,
             apart(vec3_length(vec3_sub(found->point, right->point))).text);
    ink_line(ink, "    P%d'  textbook  %s,\t%s", k + 1, world(text, found->shifted).text,
             above_words(found->above).text);
    ink_line(ink, "         exact     %s,\t%s", world(text, right->shifted).text, above_words(right->above).text);
}

/* --- A light --- */

static InkText verdict_at(const RoundingText *text, const RoundingHit *hit, int light)
{
    const RoundingLight *found = &hit->lights[light];
    InkText blocker = rounding_face(text->rounding, found->blocker);
    if (found->verdict == LIGHT_REACHES)
        return ink_text("nothing is in the way");
    if (found->verdict == LIGHT_BEHIND_FACE)
        return found->height == 0 ? ink_text("in the face's plane") : ink_text("behind the face");
    return ink_text("%s is in the way%s", blocker.text, found->blocker == hit->face ? ", the point's own face" : "");
}

static void print_light(const RoundingText *text, int k, int light)
{
    const RoundingHit *found = &text->rounding->textbook.hits[k], *right = &text->rounding->exact.hits[k];
    ink_line(&text->ink, "    textbook  N.(light - P%d) = %s:\t%s", k + 1,
             ink_number(found->lights[light].height, text->digits).text, verdict_at(text, found, light).text);
    ink_line(&text->ink, "    exact     N.(light - v0) = %s:\t%s",
             ink_number(right->lights[light].height, text->digits).text, verdict_at(text, right, light).text);
}

/* --- All steps --- */

static void step(RoundingText *text, InkText title)
{
    ink_heading(&text->ink, "Step %d. %s", text->step++, title.text);
}

static void print_parting(const RoundingText *text, RoundingPart part)
{
    ink_line(&text->ink, "\n    Here the two part.");
    print_part(text, part);
}

/* Step by step as long as both are at the same face. False: they went apart. */
static bool print_step_of_hit(RoundingText *text, int k)
{
    if (k > 0)
        text->step += 2; /* what the hit before adds, and its mirror */
    step(text,
         k == 0 ? ink_text("The nearest face along the ray") : ink_text("The nearest face in the mirror at P%d", k));
    print_hit(text, k);
    if (!rounding_same_face(text->rounding, k)) {
        print_parting(text, (RoundingPart){k, -1});
        return false;
    }
    for (int light = 0; light < text->rounding->exact.hits[k].light_count; light++) {
        step(text, ink_text("Light %d at P%d", light, k + 1));
        print_light(text, k, light);
        if (!rounding_same_verdict(text->rounding, k, light))
            print_parting(text, (RoundingPart){k, light});
    }
    return true;
}

static void print_steps(RoundingText *text)
{
    const RoundingPath *textbook = &text->rounding->textbook, *exact = &text->rounding->exact;
    text->step = 2; /* the first is the primary ray */
    int k = 0;
    while (k < exact->count && k < textbook->count && print_step_of_hit(text, k))
        k++;
    if (k + 1 < exact->count || k + 1 < textbook->count)
        ink_line(&text->ink, "\n    From here on each goes its own way.");
    ink_heading(&text->ink, "The colour of the sample");
    ink_line(&text->ink, "    textbook  %s", ink_vector(textbook->colour, 6).text);
    ink_line(&text->ink, "    exact     %s", ink_vector(exact->colour, 6).text);
}

static InkText bytes(const unsigned char *rgb)
{
    return ink_text("(%d, %d, %d)", rgb[0], rgb[1], rgb[2]);
}

static void print_summary(const RoundingText *text)
{
    const Rounding *rounding = text->rounding;
    RoundingPart part = rounding_part(rounding);
    const Ink *ink = &text->ink;
    if (part.hit < 0)
        ink_line(ink, "    Both meet the same faces and agree on every light: they part in points only.");
    else if (part.light < 0)
        ink_line(ink, "    They part at P%d, where they do not find the same face.", part.hit + 1);
    else
        ink_line(ink, "    They part at P%d, in what they say of light %d.", part.hit + 1, part.light);
    if (part.hit >= 0)
        print_part(text, part);
    ink_line(ink, "Pixel (%d, %d) = %s in textbook arithmetic, %s exactly", rounding->walk->request.column,
             rounding->walk->request.row, bytes(rounding->textbook.rgb).text, bytes(rounding->exact.rgb).text);
}

void rounding_write_text(FILE *out, const Rounding *rounding, WalkthroughStyle style)
{
    RoundingText text = {
        .ink = {out, style.colour, style.columns > 0 ? style.columns : INK_COLUMNS},
        .rounding = rounding,
        .digits = rounding->precision == PRECISION_FLOAT ? 9 : 17,
    };
    fprintf(out, "%sPixel (%d, %d) of %s%s\n", ink_colour(&text.ink, 'b'), rounding->walk->request.column,
            rounding->walk->request.row, ink_name(rounding->walk->scene_name, 60).text, ink_colour(&text.ink, '0'));
    ink_line(&text.ink, "    textbook arithmetic in %s, points shifted by %s,\tbeside the exact one",
             render_precisions[rounding->precision], ink_number((double)rounding->shift, 6).text);
    print_summary(&text);
    if (style.parts != WALKTHROUGH_SUMMARY)
        print_steps(&text);
}
