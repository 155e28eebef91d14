/* The walkthrough as text: the search for the face that a ray hits, or that stands in a shadow ray's way. */
#include "walkthrough/walkthrough_text_search.h"

#include "walkthrough/walkthrough_text_node.h"

#include <math.h>
#include <string.h>

/* --- How many faces --- */

typedef struct Reason {
    FaceVerdict verdict;
    const char *words;
} Reason;

enum { REASONS = 6 };

static const Reason path_reasons[REASONS] = {
    {FACE_PARALLEL, "parallel (N.R = 0)"},       {FACE_BEHIND, "behind (t <= 0)"},
    {FACE_BACK, "seen from behind (one-sided)"}, {FACE_OUTSIDE, "outside an edge"},
    {FACE_FARTHER, "farther than a hit before"}, {FACE_INSIDE, "hit"},
};

static const Reason shadow_reasons[REASONS] = {
    {FACE_PARALLEL, "parallel (N.R = 0)"},       {FACE_BEHIND, "behind (t <= 0)"},
    {FACE_FARTHER, "beyond the light (t >= 1)"}, {FACE_BACK, "seen from behind (one-sided)"},
    {FACE_OUTSIDE, "outside an edge"},           {FACE_INSIDE, "in the way"},
};

/* How the table of faces is set: as wide as 100 columns allow, or as 80 do. */
typedef struct TableLayout {
    int number, name, value;
    const char *between; /* the signs */
} TableLayout;

static TableLayout layout_of(const Ink *ink)
{
    return ink->columns >= INK_COLUMNS ? (TableLayout){10, 16, 12, " "} : (TableLayout){6, 12, 11, ""};
}

/* A number with as many digits, at most six, as its column has room for. */
static InkText value_of(double x, const TableLayout *at)
{
    InkText text = ink_number(x, 6);
    for (int digits = 5; ink_width(text.text) > at->value && digits > 2; digits--)
        text = ink_number(x, digits);
    return text;
}

static void print_table_head(WalkthroughText *text)
{
    TableLayout at = layout_of(&text->ink);
    bool narrow = at.between[0] == '\0';
    fprintf(text->ink.out, "\n%*s  %-*s %*s %*s %*s   %-*s  verdict\n", at.number, "face", at.name, "of", at.value,
            "N.R", at.value, "N.O + D", at.value, "t", narrow ? 5 : 8, "edges");
    text->rows_told = true;
}

/* "3 behind (t <= 0),\t1 hit": what came of the faces. */
static InkText reasons_of(const Event *event)
{
    const int *verdicts = event->as.tally.verdicts;
    bool shadow = event->as.tally.shadow;
    const Reason *reasons = shadow ? shadow_reasons : path_reasons;
    InkText line = {""};
    for (int i = 0; i < REASONS; i++)
        if (verdicts[reasons[i].verdict] > 0)
            line = ink_text("%s%s%d %s", line.text, line.text[0] ? ",\t" : "", verdicts[reasons[i].verdict],
                            reasons[i].words);
    return line;
}

void walkthrough_text_tally(WalkthroughText *text, const Event *event)
{
    int tested = event->as.tally.tested, all = text->walk->scene->face_count;
    bool tree = event->as.tally.nodes_met > 0,
         blocked = event->as.tally.shadow && event->as.tally.verdicts[FACE_INSIDE] > 0;
    const char *which = tree            ? " in the leaves that the ray enters"
                        : tested == all ? ""
                        : blocked       ? " in the order of the file"
                                        : " besides the one that the ray leaves";
    if (tree)
        walkthrough_text_nodes(text, event);
    if (tested > 0)
        ink_line(&text->ink, "    Tested %d face%s%s:\t%s.", tested, tested == 1 ? "" : "s", which,
                 reasons_of(event).text);
    else
        ink_line(&text->ink, "    No face is to be tested.");
    text->rows_told = false;
}

/* --- One face a line --- */

/* "+ + - +": the signs of the inside test; colours take no width. */
static InkText signs_of(const Ink *ink, const FaceTest *test, const char *between)
{
    InkText signs = {""};
    for (int k = 0; k < test->edges; k++)
        signs = ink_text("%s%s%s", signs.text, ink_sign(ink, test->edge_sign[k]).text, between);
    return ink_text("%s%*s", signs.text, (between[0] ? 2 : 1) * (4 - test->edges) + (between[0] ? 0 : 1), "");
}

static void print_tested(WalkthroughText *text, int face, const FaceTest *test, const char *verdict)
{
    const Scene *scene = text->walk->scene;
    const Ink *ink = &text->ink;
    if (!text->rows_told)
        print_table_head(text);
    TableLayout at = layout_of(ink);
    bool left = test->verdict == FACE_LEFT;
    InkText name = walkthrough_face_words(scene, face, at.name), none = ink_text("-");
    InkText t = test->verdict == FACE_PARALLEL || left ? none : value_of(test->t, &at);
    fprintf(ink->out, "%*d  %s%*s %*s %*s %*s   %s  %s\n", at.number, scene->faces[face].number, name.text,
            at.name - ink_width(name.text), "", at.value, left ? "-" : value_of(test->n_dot_r, &at).text, at.value,
            left ? "-" : value_of(test->n_dot_o_plus_d, &at).text, at.value, t.text,
            signs_of(ink, test, at.between).text, verdict);
    if (text->walk->request.verbose && test->edges > 0) {
        InkText values = {""};
        for (int k = 0; k < test->edges; k++)
            values = ink_text("%s\t %+.6g", values.text, test->edge_value[k] == 0 ? 0.0 : test->edge_value[k]);
        ink_line(ink, "            N.(e x c):%s", values.text);
    }
}

/* Whether the face of this event is the one that the ray will be found to hit: the list tells it further on. */
static bool is_nearest(const Event *event)
{
    const Event *hit = event;
    while (hit->kind == EVENT_FACE || hit->kind == EVENT_NODE)
        hit++;
    return hit->kind == EVENT_HIT && hit->as.hit.face == event->as.face.face;
}

/* Whether this search has met the face before: in a k-d tree a face stands in every leaf that it reaches into. */
static bool is_met_again(const Event *event)
{
    const Event *before = event - 1;
    while (before->kind == EVENT_NODE || (before->kind == EVENT_FACE && before->as.face.face != event->as.face.face))
        before--;
    return before->kind == EVENT_FACE;
}

void walkthrough_text_face_tested(WalkthroughText *text, const Event *event)
{
    const FaceTest *test = &event->as.face.test;
    InkText verdict = ink_text("%s", walkthrough_face_verdicts[test->verdict]);
    if (is_nearest(event))
        verdict = ink_text(is_met_again(event) ? "met again" : "nearest");
    else if (test->verdict == FACE_INSIDE)
        verdict = ink_text(test->t < event->as.face.nearest_t ? "nearest so far" : "not nearer");
    else if (test->verdict == FACE_OUTSIDE)
        verdict = ink_text("outside edge %d", test->outside_edge);
    else if (test->verdict == FACE_BACK)
        verdict = ink_text("back side");
    else if (test->verdict == FACE_LEFT)
        verdict = ink_text("left by ray");
    print_tested(text, event->as.face.face, test, verdict.text);
}

void walkthrough_text_occluder_tested(WalkthroughText *text, const Event *event)
{
    const FaceTest *test = &event->as.occluder.test;
    InkText verdict = ink_text("%s", walkthrough_face_verdicts[test->verdict]);
    if (test->verdict == FACE_INSIDE)
        verdict = ink_text("in the way");
    else if (test->verdict == FACE_FARTHER)
        verdict = ink_text("beyond light");
    else if (test->verdict == FACE_OUTSIDE)
        verdict = ink_text("outside edge %d", test->outside_edge);
    else if (test->verdict == FACE_BACK)
        verdict = ink_text("back side");
    print_tested(text, event->as.occluder.face, test, verdict.text);
}
