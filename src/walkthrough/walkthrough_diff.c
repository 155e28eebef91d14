/* Where the walkthroughs of two pixels part. */
#include "walkthrough/walkthrough_diff.h"

#include "walkthrough/walkthrough_diff_events.h"
#include "walkthrough/walkthrough_summary.h"
#include "walkthrough/walkthrough_summary_lights.h"
#include "walkthrough/walkthrough_words.h"

#include <string.h>

enum { SIDES = 2 };

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
    walkthrough_diff_events(diff->ink, a->walk, b->walk);
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
