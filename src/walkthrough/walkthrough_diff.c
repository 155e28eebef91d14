/* Where the walkthroughs of two pixels part. */
#include "walkthrough/walkthrough_diff.h"

#include "walkthrough/walkthrough_summary.h"
#include "walkthrough/walkthrough_summary_lights.h"
#include "walkthrough/walkthrough_words.h"

#include <string.h>

enum { SIDES = 2, DIGITS = 4 };

typedef struct Diff {
    const Ink *ink;
    const Summary *sides[SIDES];
} Diff;

static const SummaryHit *hit_of(const Summary *summary, int index)
{
    return index < summary->hit_count ? &summary->hits[index] : NULL;
}

/* What a path does at this place: the face that it hits, or how it ends. */
static InkText step_words(const Summary *summary, int index)
{
    const SummaryHit *hit = hit_of(summary, index);
    if (hit)
        return ink_text("hits %s", walkthrough_face_words(summary->walk->scene, hit->face, 40).text);
    if (index == summary->hit_count && summary->missed)
        return ink_text("leaves the scene");
    return ink_text("ends: %s", summary->end.text);
}

static bool same_lights(const Diff *diff, int index)
{
    const SummaryHit *a = hit_of(diff->sides[0], index), *b = hit_of(diff->sides[1], index);
    for (int i = 0; i < diff->sides[0]->walk->scene->light_count; i++)
        if (a->lights[i].verdict != b->lights[i].verdict || a->lights[i].blocker != b->lights[i].blocker)
            return false;
    return true;
}

/* --- Where they part --- */

/* The first thing that is not the same, in the order of the path. */
static void print_parting(const Diff *diff)
{
    const Summary *a = diff->sides[0], *b = diff->sides[1];
    for (int i = 0; i <= a->hit_count || i <= b->hit_count; i++) {
        const SummaryHit *hit_a = hit_of(a, i), *hit_b = hit_of(b, i);
        if ((hit_a ? hit_a->face : -1) != (hit_b ? hit_b->face : -1)) {
            ink_paragraph(diff->ink, "They part at P%d: the first one %s, the second one %s.", i + 1,
                          step_words(a, i).text, step_words(b, i).text);
            return;
        }
        if (hit_a && !same_lights(diff, i)) {
            ink_paragraph(diff->ink, "They part at P%d, in its lights: of the first one %s; of the second one %s.",
                          i + 1, walkthrough_summary_lights(a, hit_a, 80).text,
                          walkthrough_summary_lights(b, hit_b, 80).text);
            return;
        }
    }
    if (strcmp(a->end.text, b->end.text) != 0)
        ink_paragraph(diff->ink, "They part at the end: the first one, %s; the second one, %s.", a->end.text,
                      b->end.text);
    else
        ink_paragraph(diff->ink, "They take the same path, and the same lights reach it.");
}

/* --- What is not the same --- */

/* A row of the table, unless both sides say the same; a side that is too wide gets a line of its own. */
static void print_row(const Diff *diff, const char *label, InkText a, InkText b)
{
    enum { LABEL = 14 };
    int side = (diff->ink->columns - LABEL - 2) / 2;
    if (strcmp(a.text, b.text) == 0)
        return;
    if (ink_width(a.text) <= side && ink_width(b.text) <= side) {
        fprintf(diff->ink->out, "%-*s%s%*s  %s\n", LABEL, label, a.text, side - ink_width(a.text), "", b.text);
        return;
    }
    ink_hanging(diff->ink, LABEL, "%-*s%s", LABEL, label, a.text);
    ink_hanging(diff->ink, LABEL, "%-*s%s", LABEL, "", b.text);
}

static void print_hit(const Diff *diff, int index)
{
    InkText face[SIDES], distance[SIDES], adds[SIDES], lights[SIDES];
    for (int i = 0; i < SIDES; i++) {
        const Summary *side = diff->sides[i];
        const SummaryHit *hit = hit_of(side, index);
        face[i] = hit ? walkthrough_face_words(side->walk->scene, hit->face, 30) : ink_text("-");
        distance[i] = hit ? ink_number(hit->distance, DIGITS) : ink_text("-");
        adds[i] = hit ? ink_vector(hit->contribution, DIGITS) : ink_text("-");
        lights[i] = hit ? walkthrough_summary_lights(side, hit, 80) : ink_text("-");
    }
    print_row(diff, ink_text("P%d", index + 1).text, face[0], face[1]);
    print_row(diff, ink_text("P%d distance", index + 1).text, distance[0], distance[1]);
    print_row(diff, ink_text("P%d lights", index + 1).text, lights[0], lights[1]);
    print_row(diff, ink_text("P%d adds", index + 1).text, adds[0], adds[1]);
}

static InkText pixel_of(const Summary *summary)
{
    return ink_text("(%d, %d)", summary->walk->request.column, summary->walk->request.row);
}

static void print_diff(const Diff *diff)
{
    const Summary *a = diff->sides[0], *b = diff->sides[1];
    fprintf(diff->ink->out, "%sPixels %s and %s of %s%s\n", ink_colour(diff->ink, 'b'), pixel_of(a).text,
            pixel_of(b).text, ink_name(a->walk->scene_name, 40).text, ink_colour(diff->ink, '.'));
    print_parting(diff);
    fputc('\n', diff->ink->out);
    for (int i = 0; i < a->hit_count || i < b->hit_count; i++)
        print_hit(diff, i);
    print_row(diff, "background", a->missed ? ink_vector(a->background, DIGITS) : ink_text("-"),
              b->missed ? ink_vector(b->background, DIGITS) : ink_text("-"));
    print_row(diff, "it ends", a->end, b->end);
    print_row(diff, "bytes", ink_text("(%d, %d, %d)", a->rgb[0], a->rgb[1], a->rgb[2]),
              ink_text("(%d, %d, %d)", b->rgb[0], b->rgb[1], b->rgb[2]));
}

bool walkthrough_diff(FILE *out, const Walkthrough *walks, int count, WalkthroughStyle style, Error *error)
{
    const Ink ink = {out, style.colour, style.columns > 0 ? style.columns : INK_COLUMNS};
    for (int i = 1; i < count; i++) {
        Summary first, other;
        if (!summary_make(&first, &walks[0], error))
            return false;
        bool made = summary_make(&other, &walks[i], error);
        if (i > 1)
            fputc('\n', out);
        if (made)
            print_diff(&(Diff){&ink, {&first, &other}});
        summary_free(&first);
        summary_free(&other);
        if (!made)
            return false;
    }
    return true;
}
