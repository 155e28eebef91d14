/* The walkthrough as text: the faces that a ray was tested against, and the hit. */
#include "walkthrough_text.h"

#include <math.h>
#include <string.h>

/* --- How many faces --- */

typedef struct Reason {
    FaceVerdict verdict;
    const char *words;
} Reason;

static const Reason path_reasons[] = {
    {FACE_PARALLEL, "parallel (N.R = 0)"},       {FACE_BEHIND, "behind (t <= 0)"},
    {FACE_BACK, "seen from behind (one-sided)"}, {FACE_OUTSIDE, "outside an edge"},
    {FACE_FARTHER, "farther than a hit before"}, {FACE_INSIDE, "hit"},
};

static const Reason shadow_reasons[] = {
    {FACE_PARALLEL, "parallel (N.R = 0)"},       {FACE_BEHIND, "behind (t <= 0)"},
    {FACE_FARTHER, "beyond the light (t >= 1)"}, {FACE_BACK, "seen from behind (one-sided)"},
    {FACE_OUTSIDE, "outside an edge"},           {FACE_INSIDE, "in the way"},
};

static void print_table_head(TextWalk *text)
{
    ink_line(&text->ink, "\n      face  of                        N.R      N.O + D            t   edges     verdict");
    text->rows_told = true;
}

/* The nodes of the tree that the ray enters, in a paragraph. */
static void print_nodes(const TextWalk *text, const Event *tally)
{
    int entered = tally->as.tally.nodes_entered, told = 0;
    char line[1024];
    size_t used = (size_t)snprintf(line, sizeof line, "    Entered %d of the %d tree nodes met", entered,
                                   tally->as.tally.nodes_met);
    for (const Event *event = tally + 1;
         event->kind == EVENT_NODE || event->kind == EVENT_FACE || event->kind == EVENT_OCCLUDER; event++) {
        const WalkNode *node = &event->as.node;
        if (event->kind != EVENT_NODE || !node->entered || told == WALK_NODES_TOLD)
            continue;
        used += (size_t)snprintf(line + used, sizeof line - used, "%s %d", told++ > 0 ? "," : ":", node->node);
        if (node->faces > 0)
            used += (size_t)snprintf(line + used, sizeof line - used, " (leaf)");
    }
    ink_paragraph(&text->ink, "%s%s.", line, told < entered ? ", ..." : "");
}

void text_node(TextWalk *text, const Event *event)
{
    const WalkNode *node = &event->as.node;
    if (!text->walk->request.verbose)
        return; /* the tally has told it */
    if (!text->rows_told)
        print_table_head(text);
    int indent = node->level < 16 ? 2 * node->level : 32;
    InkText leaf = node->faces > 0 ? ink_text(", a leaf of %d face%s", node->faces, node->faces == 1 ? "" : "s")
                                   : ink_text("%s", "");
    ink_line(&text->ink, "      %*snode %d, %s%s", indent, "", node->node, node->entered ? "entered" : "left aside",
             node->entered ? leaf.text : "");
}

void text_tally(TextWalk *text, const Event *event)
{
    const int *verdicts = event->as.tally.verdicts;
    int tested = event->as.tally.tested, all = text->walk->scene->face_count;
    bool shadow = event->as.tally.shadow;
    const Reason *reasons = shadow ? shadow_reasons : path_reasons;
    int count = shadow ? sizeof shadow_reasons / sizeof *reasons : sizeof path_reasons / sizeof *reasons;
    char line[512] = "";
    for (int i = 0; i < count; i++)
        if (verdicts[reasons[i].verdict] > 0) {
            size_t used = strlen(line);
            snprintf(line + used, sizeof line - used, "%s%d %s", used > 0 ? ",\t" : "", verdicts[reasons[i].verdict],
                     reasons[i].words);
        }
    const char *which = event->as.tally.nodes_met > 0     ? " in the leaves that the ray enters"
                        : tested == all                   ? ""
                        : shadow && verdicts[FACE_INSIDE] ? " in the order of the file"
                                                          : " besides the one that the ray leaves";
    if (event->as.tally.nodes_met > 0)
        print_nodes(text, event);
    ink_line(&text->ink, "    Tested %d face%s%s:\t%s.", tested, tested == 1 ? "" : "s", which,
             tested > 0 ? line : "none");
    text->rows_told = false;
}

/* --- One face a line --- */

/* "+ + - +": the signs of the inside test; colours take no width. */
static InkText signs_of(const Ink *ink, const FaceTest *test)
{
    InkText signs = {""};
    for (int k = 0; k < test->edges; k++) {
        char sign = test->edge_sign[k] > 0 ? '+' : test->edge_sign[k] < 0 ? '-' : '0';
        signs = ink_text("%s%s%c%s ", signs.text, ink_colour(ink, sign), sign, ink_colour(ink, '.'));
    }
    return ink_text("%s%*s", signs.text, 2 * (4 - test->edges), "");
}

void text_tested(TextWalk *text, int face, const FaceTest *test, const char *verdict)
{
    const Scene *scene = text->walk->scene;
    if (!text->rows_told)
        print_table_head(text);
    InkText t = test->verdict == FACE_PARALLEL || test->verdict == FACE_LEFT ? ink_text("-") : ink_number(test->t, 6);
    InkText number = ink_text("%d", scene->faces[face].number);
    if (test->verdict == FACE_LEFT) {
        ink_line(&text->ink, "    %6s  %-16s %12s %12s %12s   %-8s  %s", number.text, text_face(scene, face, 16).text,
                 "-", "-", "-", "", verdict);
        return;
    }
    ink_line(&text->ink, "    %6s  %-16s %12s %12s %12s   %s  %s", number.text, text_face(scene, face, 16).text,
             ink_number(test->n_dot_r, 6).text, ink_number(test->n_dot_o_plus_d, 6).text, t.text,
             signs_of(&text->ink, test).text, verdict);
    if (text->walk->request.verbose && test->edges > 0) {
        InkText values = {""};
        for (int k = 0; k < test->edges; k++)
            values = ink_text("%s  %+.6g", values.text, test->edge_value[k] == 0 ? 0.0 : test->edge_value[k]);
        ink_line(&text->ink, "            dot(N, cross(e, c)):%s", values.text);
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

void text_face_tested(TextWalk *text, const Event *event)
{
    const FaceTest *test = &event->as.face.test;
    InkText verdict = ink_text("%s", walk_face_verdicts[test->verdict]);
    if (is_nearest(event))
        verdict = ink_text("nearest");
    else if (test->verdict == FACE_INSIDE)
        verdict = ink_text(test->t < event->as.face.nearest_t ? "nearest so far" : "not nearer");
    else if (test->verdict == FACE_OUTSIDE)
        verdict = ink_text("outside edge %d", test->outside_edge);
    else if (test->verdict == FACE_BACK)
        verdict = ink_text("back side");
    else if (test->verdict == FACE_LEFT)
        verdict = ink_text("left by ray");
    text_tested(text, event->as.face.face, test, verdict.text);
}

void text_occluder_tested(TextWalk *text, const Event *event)
{
    const FaceTest *test = &event->as.occluder.test;
    InkText verdict = ink_text("%s", walk_face_verdicts[test->verdict]);
    if (test->verdict == FACE_INSIDE)
        verdict = ink_text("in the way");
    else if (test->verdict == FACE_FARTHER)
        verdict = ink_text("beyond light");
    else if (test->verdict == FACE_OUTSIDE)
        verdict = ink_text("outside edge %d", test->outside_edge);
    else if (test->verdict == FACE_BACK)
        verdict = ink_text("back side");
    text_tested(text, event->as.occluder.face, test, verdict.text);
}

/* --- The hit --- */

static void print_plane_hit(const TextWalk *text, const Event *event)
{
    const Ink *ink = &text->ink;
    const Scene *scene = text->walk->scene;
    const FaceTest *test = &event->as.hit.test;
    const Face *face = &scene->faces[event->as.hit.face];
    Vec3 normal = scene->planes[event->as.hit.face].normal;
    InkText n = ink_vector(normal, 6);
    InkRow rows[4];
    for (int k = 0; k < face->vertex_count; k++)
        rows[k] = text_place_row(text, ink_text("v%d", k), face_vertex(face, k));
    ink_rows(ink, rows, face->vertex_count);
    fputc('\n', ink->out);
    const char *formula = face->vertex_count == 4 ? "unit((v2 - v0) x (v3 - v1))" : "unit((v1 - v0) x (v2 - v0))";
    ink_line(ink, "    N       = %s = %s", formula, n.text);
    ink_line(ink, "    N.R     = %s.%s\t= %s", n.text, ink_vector(text->place.ray.direction, 6).text,
             ink_number(test->n_dot_r, 6).text);
    ink_line(ink, "    N.O + D = N.(O - v0) = %s.%s\t= %s", n.text,
             ink_vector(vec3_sub(text->place.ray.origin, face_vertex(face, 0)), 6).text,
             ink_number(test->n_dot_o_plus_d, 6).text);
    ink_line(ink, "    t       = -(N.O + D) / (N.R) = -(%s) / (%s) = %s", ink_number(test->n_dot_o_plus_d, 6).text,
             ink_number(test->n_dot_r, 6).text, ink_number(test->t, 6).text);
    fputc('\n', ink->out);
}

static void print_inside_test(const TextWalk *text, const Event *event)
{
    const Ink *ink = &text->ink;
    const Face *face = &text->walk->scene->faces[event->as.hit.face];
    const FaceTest *test = &event->as.hit.test;
    int number = event->as.hit.step + 1;
    ink_line(ink,
             "\n    Inside? For each edge e = v[k+1] - v[k] and c = P%d - v[k], the sign of dot(N, cross(e, c)):\n",
             number);
    InkText e[4], c[4];
    int wide_e = 0, wide_c = 0;
    for (int k = 0; k < test->edges; k++) {
        WalkEdge edge = walk_edge(face, k, event->as.hit.point);
        e[k] = ink_vector(edge.e, 5);
        c[k] = ink_vector(edge.c, 5);
        wide_e = (int)fmax(wide_e, (double)strlen(e[k].text));
        wide_c = (int)fmax(wide_c, (double)strlen(c[k].text));
    }
    ink_line(ink, "    edge      %-*s  %-*s  dot(N, cross(e, c))", wide_e, "e", wide_c, "c");
    bool zero = false;
    for (int k = 0; k < test->edges; k++) {
        char sign = test->edge_sign[k] > 0 ? '+' : test->edge_sign[k] < 0 ? '-' : '0';
        zero = zero || sign == '0';
        ink_line(ink, "    v%d -> v%d  %-*s  %-*s  %12s   %s%c%s", k, (k + 1) % test->edges, wide_e, e[k].text, wide_c,
                 c[k].text, ink_number(test->edge_value[k], 6).text, ink_colour(ink, sign), sign, ink_colour(ink, '.'));
    }
    ink_line(ink,
             zero ? "\n    No sign is -, and 0 is on the edge's own line, which counts as inside: P%d is on the face."
                  : "\n    No sign is -: P%d is on the face.",
             number);
}

static void print_shift(const TextWalk *text, const Event *event)
{
    const Ink *ink = &text->ink;
    int number = event->as.hit.step + 1;
    Vec3 normal = event->as.hit.normal;
    double shift = vec3_dot(normal, vec3_sub(event->as.hit.shifted, event->as.hit.point));
    if (event->as.hit.test.n_dot_r > 0)
        ink_line(ink, "    N.R > 0, the ray came from behind: from here N is turned to its side, N = %s.",
                 ink_vector(normal, 6).text);
    ink_line(ink, "    Rays that leave start at P%d' = P%d + %s N, which rounding cannot put behind the face.", number,
             number, ink_number(shift, 3).text);
}

void text_hit(TextWalk *text, const Event *event)
{
    const Scene *scene = text->walk->scene;
    int number = event->as.hit.step + 1;
    const Face *face = &scene->faces[event->as.hit.face];
    ink_line(&text->ink, "\n    The nearest is face %d, %s, material %s:\n", face->number,
             text_face(scene, event->as.hit.face, 40).text, ink_name(scene->materials[face->material].name, 24).text);
    print_plane_hit(text, event);
    InkRow rows[] = {
        text_place_row(text, ink_text("O"), text->place.ray.origin),
        text_row(ink_text("t R"), vec3_scale(event->as.hit.test.t, text->place.ray.direction)),
        text_place_row(text, ink_text("P%d = O + t R", number), event->as.hit.point),
    };
    ink_rows(&text->ink, rows, sizeof rows / sizeof *rows);
    print_inside_test(text, event);
    print_shift(text, event);
}
