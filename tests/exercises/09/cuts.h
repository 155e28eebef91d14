/* Tests of cut_cost and best_cut. Included by test.c alone, after the student's file. */
#ifndef EXERCISE_CUTS_H
#define EXERCISE_CUTS_H

#include "scene/geometry.h"

#include <stdlib.h>

#define ORIGINAL "scenes/original.json"
#define CORNELL "scenes/cornell.json"

enum { MOST_FACES = 64 };

typedef struct Part {
    Box box;
    Box faces[MOST_FACES];
    int count;
} Part;

static double side_of_box(Box box, int axis)
{
    return (double)box.high[axis] - (double)box.low[axis];
}

static double half_surface(Box box)
{
    double x = side_of_box(box, 0), y = side_of_box(box, 1), z = side_of_box(box, 2);
    return x * y + y * z + z * x;
}

static Box part_of(Box box, int axis, float position, bool low)
{
    if (low)
        box.high[axis] = position;
    else
        box.low[axis] = position;
    return box;
}

typedef enum CostSlip {
    COST_RIGHT,
    COST_NO_STEP,
    COST_SWAPPED,
    COST_VOLUME,
    COST_NOT_DIVIDED,
    COST_NO_SURFACE,
    COST_NO_BONUS,
    COST_BONUS_ALWAYS,
    COST_SLIPS
} CostSlip;

static const char *const COST_TEXTS[COST_SLIPS] = {
    [COST_NO_STEP] = "the step down, 1, is left out",
    [COST_SWAPPED] = "the counts are exchanged: the low part's surface goes with low_count",
    [COST_VOLUME] = "volumes are taken for surfaces: the chance that a line meets a box grows with its surface",
    [COST_NOT_DIVIDED] = "the sum is not divided by the surface of the whole",
    [COST_NO_SURFACE] = "the parts' lengths along the axis are taken for their surfaces",
    [COST_NO_BONUS] = "the 0.8 for an empty part is left out",
    [COST_BONUS_ALWAYS] = "all cuts get the 0.8, not only those with an empty part",
};

static double cost_with(CostSlip slipped, Box box, int axis, float position, int low_count, int high_count)
{
    Box low = part_of(box, axis, position, true), high = part_of(box, axis, position, false);
    double whole = half_surface(box), a = half_surface(low), b = half_surface(high);
    if (slipped == COST_VOLUME) {
        whole = side_of_box(box, 0) * side_of_box(box, 1) * side_of_box(box, 2);
        a = whole * side_of_box(low, axis) / side_of_box(box, axis);
        b = whole - a;
    } else if (slipped == COST_NO_SURFACE) {
        whole = side_of_box(box, axis);
        a = side_of_box(low, axis);
        b = side_of_box(high, axis);
    }
    double first = slipped == COST_SWAPPED ? high_count : low_count;
    double second = slipped == COST_SWAPPED ? low_count : high_count;
    double sum = a * first + b * second;
    double cost = (slipped == COST_NO_STEP ? 0 : 1) + (slipped == COST_NOT_DIVIDED ? sum : sum / whole);
    bool empty = low_count == 0 || high_count == 0;
    return (empty && slipped != COST_NO_BONUS) || slipped == COST_BONUS_ALWAYS ? 0.8 * cost : cost;
}

static const char *box_text(Box box)
{
    static char texts[4][160];
    static int next;
    char *text = texts[next++ % 4];
    snprintf(text, sizeof texts[0], "(%g, %g, %g) to (%g, %g, %g)", (double)box.low[0], (double)box.low[1],
             (double)box.low[2], (double)box.high[0], (double)box.high[1], (double)box.high[2]);
    return text;
}

static void judge_cost(Box box, int axis, float position, int low_count, int high_count)
{
    given("box", "%s", box_text(box));
    given("axis", "%d", axis);
    given("position", "%g", (double)position);
    given("counts", "%d low, %d high", low_count, high_count);
    double whole = half_surface(box), low = half_surface(part_of(box, axis, position, true));
    double high = half_surface(part_of(box, axis, position, false));
    double cost = cost_with(COST_RIGHT, box, axis, position, low_count, high_count);
    Outcome returned = {0}, expected = {0};
    add_number(&expected, "the cost", cost);
    add_formula(&expected, "%s(1 + (%s x %d + %s x %d) / %s) = %s, with half of each surface",
                low_count == 0 || high_count == 0 ? "0.8 " : "", number_text(low), low_count, number_text(high),
                high_count, number_text(whole), number_text(cost));
    for (CostSlip k = COST_RIGHT + 1; k < COST_SLIPS; k++) {
        Outcome slipped = {0};
        add_number(&slipped, "the cost", cost_with(k, box, axis, position, low_count, high_count));
        slip(&slipped, "%s", COST_TEXTS[k]);
    }
    add_number(&returned, "the cost", cut_cost(box, axis, position, low_count, high_count));
    compare(&returned, &expected);
}

static void cost_of_a_cut(void)
{
    shown_with(ORIGINAL, 60, 60, "--size 128x96 --accel kdtree -v");
    judge_cost((Box){{-200, -5, 0.1f}, {200, 15, 20.2f}}, 0, -3, 11, 11);
    judge_cost((Box){{-200, -5, 0.1f}, {200, 15, 20.2f}}, 1, 11, 3, 11);
    judge_cost((Box){{0, 0, 0}, {4, 2, 8}}, 2, 2, 5, 1);
}

static void empty_part(void)
{
    shown_with(ORIGINAL, 60, 60, "--size 128x96 --accel kdtree -v");
    judge_cost((Box){{0, 0, 0}, {4, 2, 8}}, 2, 2, 0, 6);
    judge_cost((Box){{0, 0, 0}, {4, 2, 8}}, 0, 3, 6, 0);
}

/* --- The best cut --- */

typedef enum CutSlip {
    CUT_RIGHT,
    CUT_FIRST_AXIS,
    CUT_LONGEST,
    CUT_BEGINS,
    CUT_TOUCHING,
    CUT_PLANAR_LOW,
    CUT_NOT_AT_ENDS,
    CUT_SLIPS
} CutSlip;

static const char *const CUT_TEXTS[CUT_SLIPS] = {
    [CUT_FIRST_AXIS] = "only cuts across x are tried",
    [CUT_LONGEST] = "only the longest side of the box is cut: the heuristic decides about the axis, too",
    [CUT_BEGINS] = "only planes where a face's box begins are tried, not those where one ends",
    [CUT_TOUCHING] = "a face that only touches the plane counts on both sides: < is right, not <=",
    [CUT_PLANAR_LOW] = "faces in the plane always go to the low side: try both",
    [CUT_NOT_AT_ENDS] = "planes in a side of the box are never tried: there, a face that is flat is a part of its own",
};

static void count_sides(const Part *part, Cut *cut, bool planar_low, bool touching)
{
    cut->low_count = cut->high_count = 0;
    for (int i = 0; i < part->count; i++) {
        float low = part->faces[i].low[cut->axis], high = part->faces[i].high[cut->axis];
        bool flat = low == high && low == cut->position;
        cut->low_count += low < cut->position || (flat && planar_low) || (touching && low == cut->position);
        cut->high_count += high > cut->position || (flat && !planar_low) || (touching && high == cut->position);
    }
}

static void try_plane(const Part *part, Cut cut, CutSlip slipped, Cut *best)
{
    for (int planar_low = 1; planar_low >= (slipped == CUT_PLANAR_LOW ? 1 : 0); planar_low--) {
        count_sides(part, &cut, planar_low, slipped == CUT_TOUCHING);
        if ((cut.position == part->box.low[cut.axis] && cut.low_count == 0) ||
            (cut.position == part->box.high[cut.axis] && cut.high_count == 0))
            continue;
        if (slipped == CUT_NOT_AT_ENDS &&
            (cut.position == part->box.low[cut.axis] || cut.position == part->box.high[cut.axis]))
            continue;
        cut.cost = cost_with(COST_RIGHT, part->box, cut.axis, cut.position, cut.low_count, cut.high_count);
        if (cut.cost < best->cost)
            *best = cut;
    }
}

static Cut best_with(const Part *part, CutSlip slipped)
{
    Cut best = {.cost = HUGE_VAL};
    int longest = 0;
    for (int axis = 1; axis < 3; axis++)
        if (side_of_box(part->box, axis) > side_of_box(part->box, longest))
            longest = axis;
    for (int axis = 0; axis < (slipped == CUT_FIRST_AXIS ? 1 : 3); axis++) {
        if (side_of_box(part->box, axis) == 0 || (slipped == CUT_LONGEST && axis != longest))
            continue;
        for (int i = 0; i < part->count; i++) {
            try_plane(part, (Cut){.axis = axis, .position = part->faces[i].low[axis]}, slipped, &best);
            if (slipped != CUT_BEGINS)
                try_plane(part, (Cut){.axis = axis, .position = part->faces[i].high[axis]}, slipped, &best);
        }
    }
    return best;
}

/* The cost decides, since several cuts may cost the same. Its own numbers must belong together. */
static Outcome outcome_of_cut(Cut cut, double cost_of_its_plane)
{
    Outcome outcome = {0};
    add_number(&outcome, "the cut's cost", cut.cost);
    add_number(&outcome, "the cost of a cut there", cost_of_its_plane);
    return outcome;
}

static double cost_there(const Part *part, Cut cut)
{
    double least = (double)NAN;
    for (int planar_low = 0; planar_low < 2; planar_low++) {
        Cut own = cut;
        if (cut.axis < 0 || cut.axis > 2)
            return (double)NAN;
        count_sides(part, &own, planar_low, false);
        if (own.low_count == cut.low_count && own.high_count == cut.high_count)
            least = cost_with(COST_RIGHT, part->box, cut.axis, cut.position, cut.low_count, cut.high_count);
    }
    return least;
}

static void judge_cut(const Part *part)
{
    given("box", "%s", box_text(part->box));
    given("faces", "%d", part->count);
    for (int i = 0; i < part->count && i < 6; i++)
        given((const char *[]){"face 0", "face 1", "face 2", "face 3", "face 4", "face 5"}[i], "%s",
              box_text(part->faces[i]));
    Cut right = best_with(part, CUT_RIGHT), cut = best_cut(part->box, part->faces, part->count);
    if (cut.cost == HUGE_VAL)
        given("your cut", "none");
    else
        given("your cut", "%c = %g, %d low, %d high", "xyz?"[cut.axis >= 0 && cut.axis < 3 ? cut.axis : 3],
              (double)cut.position, cut.low_count, cut.high_count);
    Outcome returned = outcome_of_cut(cut, cost_there(part, cut)), expected = {0};
    add_number(&expected, "the cut's cost", right.cost);
    add_formula(&expected, "the cheapest cut is at %c = %s, with %d faces low and %d high: it costs %s",
                "xyz"[right.axis], number_text((double)right.position), right.low_count, right.high_count,
                number_text(right.cost));
    add_number(&expected, "the cost of a cut there", right.cost);
    add_formula(&expected, "the cut's counts and cost do not belong to its axis and position");
    for (CutSlip k = CUT_RIGHT + 1; k < CUT_SLIPS; k++) {
        Cut made = best_with(part, k);
        Outcome slipped = outcome_of_cut(made, cost_there(part, made));
        slip(&slipped, "%s", CUT_TEXTS[k]);
    }
    compare(&returned, &expected);
}

static void three_boxes(void)
{
    shown_with(ORIGINAL, 60, 60, "--size 128x96 --accel kdtree -v");
    Part part = {.box = {{0, 0, 0}, {10, 4, 4}}, .count = 3};
    part.faces[0] = (Box){{0, 0, 0}, {2, 4, 4}};
    part.faces[1] = (Box){{1, 0, 0}, {4, 4, 4}};
    part.faces[2] = (Box){{8, 0, 0}, {10, 4, 4}};
    judge_cut(&part);
    Part across = {.box = {{0, 0, 0}, {10, 4, 4}}, .count = 4};
    for (int i = 0; i < 4; i++)
        across.faces[i] = (Box){{0, i < 2 ? 0 : 3, (float)i}, {10, i < 2 ? 1 : 4, 1 + (float)i}};
    judge_cut(&across);
}

static void flat_faces(void)
{
    shown_with(ORIGINAL, 60, 60, "--size 128x96 --accel kdtree -v");
    Part part = {.box = {{0, 0, 0}, {10, 4, 4}}, .count = 4};
    part.faces[0] = (Box){{0, 0, 0}, {0, 4, 4}};
    part.faces[1] = (Box){{3, 0, 0}, {3, 4, 4}};
    part.faces[2] = (Box){{3, 1, 1}, {10, 3, 3}};
    part.faces[3] = (Box){{5, 0, 2}, {6, 4, 2}};
    judge_cut(&part);
    part.count = 1;
    judge_cut(&part);
    Part low = {.box = {{0, 0, 0}, {10, 4, 4}}, .count = 3};
    low.faces[0] = (Box){{7, 0, 0}, {7, 4, 4}};
    low.faces[1] = (Box){{7, 1, 1}, {9, 2, 2}};
    low.faces[2] = (Box){{7, 2, 0}, {10, 4, 4}};
    judge_cut(&low);
}

/* Keeps the low or the high side of a cut, as the builder of a tree does. */
static void keep_side(Part *part, Cut cut, bool low, bool planar_low)
{
    Part kept = {.box = part_of(part->box, cut.axis, cut.position, low)};
    for (int i = 0; i < part->count; i++) {
        Box face = part->faces[i];
        bool flat = face.low[cut.axis] == face.high[cut.axis] && face.low[cut.axis] == cut.position;
        bool on_it = flat  ? low == planar_low
                     : low ? face.low[cut.axis] < cut.position
                           : face.high[cut.axis] > cut.position;
        if (!on_it)
            continue;
        if (low && face.high[cut.axis] > cut.position)
            face.high[cut.axis] = cut.position;
        if (!low && face.low[cut.axis] < cut.position)
            face.low[cut.axis] = cut.position;
        kept.faces[kept.count++] = face;
    }
    *part = kept;
}

/* Whether the cut has its flat faces on the low side. */
static bool has_planar_low(const Part *part, Cut cut)
{
    Cut own = cut;
    count_sides(part, &own, true, false);
    return own.low_count == cut.low_count && own.high_count == cut.high_count;
}

static void judge_part(Part part, int depth)
{
    if (part.count < 2 || depth == 0)
        return;
    judge_cut(&part);
    Cut cut = best_with(&part, CUT_RIGHT);
    bool planar_low = has_planar_low(&part, cut);
    if (!(cut.cost < part.count))
        return;
    Part low = part;
    keep_side(&low, cut, true, planar_low);
    keep_side(&part, cut, false, planar_low);
    judge_part(low, depth - 1);
    judge_part(part, depth - 1);
}

static Part part_of_scene(const char *path)
{
    const Scene *scene = scene_of(path);
    Part part = {.box = box_empty()};
    for (int i = 0; i < scene->face_count && i < MOST_FACES; i++) {
        part.faces[part.count++] = face_box(&scene->faces[i], &scene->planes[i]);
        part.box = box_union(part.box, part.faces[i]);
    }
    return part;
}

static void cuts_of_a_scene(void)
{
    shown_with(ORIGINAL, 60, 60, "--size 128x96 --accel kdtree -v");
    judge_part(part_of_scene(ORIGINAL), 4);
    shown_with(CORNELL, 256, 256, "--accel kdtree -v");
    judge_part(part_of_scene(CORNELL), 4);
}

#endif
