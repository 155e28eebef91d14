/* Tests of walk. Included by test.c alone, after the student's file. */
#ifndef EXERCISE_WALKS_H
#define EXERCISE_WALKS_H

#include "exercises/09/cuts.h"

enum { VISITS = 8 };

/* What a walk did: the faces it showed, in order. */
typedef struct Steps {
    int faces[VISITS], count;
    double limits[VISITS]; /* to which each visit lowers the limit; 0: it does not */
    int stop_at;           /* the visit that ends the search; 0: none */
} Steps;

static bool record_visit(Traversal *way, int face)
{
    Steps *steps = way->user;
    int k = steps->count++;
    if (k < VISITS) {
        steps->faces[k] = face;
        if (steps->limits[k] > 0 && steps->limits[k] < way->limit)
            way->limit = steps->limits[k];
    }
    return k + 1 != steps->stop_at;
}

typedef enum WalkSlip {
    WALK_RIGHT,
    WALK_LOW_FIRST,
    WALK_FAR_FIRST,
    WALK_WHOLE_PARTS,
    WALK_NO_LIMIT,
    WALK_LIMIT_EXCLUDED,
    WALK_NO_MISS,
    WALK_GOES_ON,
    WALK_CHILD_UNHEARD,
    WALK_NOT_COUNTED,
    WALK_ONLY_NEAR,
    WALK_SLIPS
} WalkSlip;

static const char *const WALK_TEXTS[WALK_SLIPS] = {
    [WALK_LOW_FIRST] = "the low child is always walked first: a ray with a direction below 0 comes from the high side",
    [WALK_FAR_FIRST] = "the far child is walked first",
    [WALK_WHOLE_PARTS] = "both children get the whole part of the ray: cut it at the plane",
    [WALK_NO_LIMIT] = "a node that the ray enters beyond the limit is walked through all the same",
    [WALK_LIMIT_EXCLUDED] = "a node that the ray enters exactly at the limit is left out: it is not beyond",
    [WALK_NO_MISS] = "a node is walked through although the ray is never in its box: enter > leave",
    [WALK_GOES_ON] = "the walk goes on after `visit` gave back false",
    [WALK_CHILD_UNHEARD] = "the walk goes on although that of a child gave back false",
    [WALK_NOT_COUNTED] = "nodes are counted only where they are walked through: count first",
    [WALK_ONLY_NEAR] = "only the near child is walked through",
};

/* As ours, with a slip in it. */
static bool walk_with(WalkSlip slipped, const KdTree *tree, int index, Interval part, Traversal *way)
{
    const KdNode *node = &tree->nodes[index];
    way->box_tests += slipped != WALK_NOT_COUNTED;
    if (!(part.enter <= part.leave) && slipped != WALK_NO_MISS)
        return true;
    if (part.enter > way->limit && slipped != WALK_NO_LIMIT)
        return true;
    if (part.enter == way->limit && slipped == WALK_LIMIT_EXCLUDED)
        return true;
    way->box_tests += slipped == WALK_NOT_COUNTED;
    bool good = true;
    if (node->axis == KDTREE_LEAF) {
        for (int i = 0; i < node->count && good; i++)
            good = way->visit(way, tree->order[node->first + i]) || slipped == WALK_GOES_ON;
        return good;
    }
    double o = vec3_component(way->origin, node->axis), r = vec3_component(way->direction, node->axis);
    Interval low = interval_common(part, interval_between(-HUGE_VAL, (double)node->split, o, r));
    Interval high = interval_common(part, interval_between((double)node->split, HUGE_VAL, o, r));
    if (slipped == WALK_WHOLE_PARTS)
        low = high = part;
    bool from_high = slipped == WALK_LOW_FIRST ? false : (r < 0) != (slipped == WALK_FAR_FIRST);
    int children[2] = {index + 1, node->first};
    Interval parts[2] = {low, high};
    for (int k = 0; k < (slipped == WALK_ONLY_NEAR ? 1 : 2) && good; k++) {
        int child = from_high ? 1 - k : k;
        good = walk_with(slipped, tree, children[child], parts[child], way) || slipped == WALK_CHILD_UNHEARD;
    }
    return good;
}

static Outcome outcome_of_walk(const Steps *steps, const Traversal *way, bool good)
{
    Outcome outcome = {0};
    static const char *const names[VISITS] = {"visit 1: face", "visit 2: face", "visit 3: face", "visit 4: face",
                                              "visit 5: face", "visit 6: face", "visit 7: face", "visit 8: face"};
    for (int k = 0; k < VISITS; k++)
        add_integer(&outcome, names[k], k < steps->count ? steps->faces[k] : -1);
    add_integer(&outcome, "visits", steps->count);
    add_integer(&outcome, "way->box_tests", (int)way->box_tests);
    add_truth(&outcome, "the answer", good);
    return outcome;
}

static Traversal way_of(Ray ray, double limit, Steps *steps)
{
    return (Traversal){
        .origin = ray.origin, .direction = ray.direction, .limit = limit, .visit = record_visit, .user = steps};
}

static void give_faces(const Outcome *expected)
{
    char text[200] = "";
    int length = 0;
    for (int k = 0; k < VISITS && expected->values[k].value >= 0; k++)
        length +=
            snprintf(text + length, sizeof text - (size_t)length, "%s%g", k ? ", " : "", expected->values[k].value);
    given("the right order", "%s (-1: no visit)", length ? text : "no face at all");
}

/* `steps`: what the visits are to do. */
static void judge_walk(const KdTree *tree, Ray ray, double limit, Steps steps)
{
    Interval part = interval_in_box(tree->box, ray.origin, ray.direction);
    given("origin", "%s", vector_text(ray.origin));
    given("direction", "%s", vector_text(ray.direction));
    given("part", "%s to %s", number_text(part.enter), number_text(part.leave));
    given("way->limit", "%s", number_text(limit));
    for (int i = 0; i < tree->node_count && i < 5; i++) {
        const KdNode *node = &tree->nodes[i];
        const char *name = (const char *[]){"node 0", "node 1", "node 2", "node 3", "node 4"}[i];
        if (node->axis == KDTREE_LEAF)
            given(name, "a leaf of %d faces", node->count);
        else
            given(name, "%c = %s, children %d and %d", "xyz"[node->axis], number_text((double)node->split), i + 1,
                  node->first);
    }
    Steps ours = steps, theirs = steps;
    Traversal way = way_of(ray, limit, &ours);
    bool good = walk_with(WALK_RIGHT, tree, 0, part, &way);
    Outcome expected = outcome_of_walk(&ours, &way, good);
    give_faces(&expected);
    for (WalkSlip k = WALK_RIGHT + 1; k < WALK_SLIPS; k++) {
        Steps own = steps;
        way = way_of(ray, limit, &own);
        bool slipped_good = walk_with(k, tree, 0, part, &way);
        Outcome slipped = outcome_of_walk(&own, &way, slipped_good);
        slip(&slipped, "%s", WALK_TEXTS[k]);
    }
    way = way_of(ray, limit, &theirs);
    good = walk(tree, 0, part, &way);
    Outcome returned = outcome_of_walk(&theirs, &way, good);
    compare(&returned, &expected);
}

/* Three leaves along x: faces 0 and 1 below x = 2, face 2 from 2 to 5, faces 3 and 4 above. */
static KdTree small_tree(void)
{
    static KdNode nodes[5] = {{.split = 2, .axis = 0, .first = 2},
                              {.axis = KDTREE_LEAF, .first = 0, .count = 2},
                              {.split = 5, .axis = 0, .first = 4},
                              {.axis = KDTREE_LEAF, .first = 2, .count = 1},
                              {.axis = KDTREE_LEAF, .first = 3, .count = 2}};
    static int order[5] = {0, 1, 2, 3, 4};
    return (KdTree){.box = {{0, 0, 0}, {10, 4, 4}}, .nodes = nodes, .order = order, .node_count = 5, .order_count = 5};
}

static void shown_by_the_gallery(void)
{
    shown_with("scenes/gallery.json", 900, 390, "--accel kdtree -v");
}

static void a_leaf(void)
{
    static KdNode leaf = {.axis = KDTREE_LEAF, .first = 1, .count = 3};
    static int order[4] = {9, 4, 7, 8};
    KdTree tree = {.box = {{0, 0, 0}, {10, 4, 4}}, .nodes = &leaf, .order = order, .node_count = 1, .order_count = 4};
    shown_by_the_gallery();
    judge_walk(&tree, (Ray){vec3(-1, 2, 2), vec3(1, 0, 0)}, HUGE_VAL, (Steps){0});
    judge_walk(&tree, (Ray){vec3(-1, 9, 2), vec3(1, 0, 0)}, HUGE_VAL, (Steps){0});
}

static void near_first(void)
{
    KdTree tree = small_tree();
    shown_by_the_gallery();
    judge_walk(&tree, (Ray){vec3(-1, 2, 2), vec3(1, 0.1, 0)}, HUGE_VAL, (Steps){0});
    judge_walk(&tree, (Ray){vec3(11, 2, 2), vec3(-1, 0.1, 0)}, HUGE_VAL, (Steps){0});
}

static void own_parts(void)
{
    KdTree tree = small_tree();
    shown_by_the_gallery();
    judge_walk(&tree, (Ray){vec3(3, 2, 2), vec3(1, 0, 0)}, HUGE_VAL, (Steps){0});
    judge_walk(&tree, (Ray){vec3(4, 5, 2), vec3(-1, -1, 0)}, HUGE_VAL, (Steps){0});
    judge_walk(&tree, (Ray){vec3(3, -1, 2), vec3(0, 1, 0)}, HUGE_VAL, (Steps){0});
}

static void not_beyond_the_limit(void)
{
    KdTree tree = small_tree();
    shown_by_the_gallery();
    judge_walk(&tree, (Ray){vec3(-1, 2, 2), vec3(1, 0, 0)}, 3.5, (Steps){0});
    judge_walk(&tree, (Ray){vec3(-1, 2, 2), vec3(1, 0, 0)}, HUGE_VAL, (Steps){.limits = {0, 2.5}});
    /* The root, since the t of a plane inside depends on how it is rounded. */
    Ray ray = {vec3(-1, 2, 2), vec3(1, 0, 0)};
    judge_walk(&tree, ray, interval_in_box(tree.box, ray.origin, ray.direction).enter, (Steps){0});
}

static void stops_when_told(void)
{
    KdTree tree = small_tree();
    shown_by_the_gallery();
    judge_walk(&tree, (Ray){vec3(-1, 2, 2), vec3(1, 0, 0)}, HUGE_VAL, (Steps){.stop_at = 1});
    judge_walk(&tree, (Ray){vec3(11, 2, 2), vec3(-1, 0, 0)}, HUGE_VAL, (Steps){.stop_at = 3});
}

static const KdTree *tree_of_scene(const char *path)
{
    static KdTree tree;
    static bool built;
    Error error = {0};
    if (!built && !kdtree_build(&tree, scene_of(path), 1, &error))
        abort();
    built = true;
    return &tree;
}

static void walks_of_a_scene(void)
{
    const Scene *scene = scene_of(CORNELL);
    View view = view_of(scene);
    view.grid = 1;
    for (int k = 0; k < 300; k++) {
        int column = k * 37 % view.columns, row = k * 61 % view.rows;
        shown_with(CORNELL, column, row, "--accel kdtree -v");
        Ray ray = {view.eye, view_direction(&view, column, row, 0, 0)};
        judge_walk(tree_of_scene(CORNELL), ray, k % 2 ? HUGE_VAL : 800, (Steps){.limits = {0, 0, 0, k % 3 ? 0 : 900}});
    }
}

#endif
