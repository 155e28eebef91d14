/* Exercise 3, the inside test: `inside_edges` of the student beside ours. Each test is a pixel of the scene and one of
 * its faces. */
#include "exercises/textbook.h"

/* Ours, under another name. */
#define inside_edges our_inside_edges
#undef RECTRAY_TEXTBOOK_INSIDE_H
#include "src/trace/textbook_inside.h"
#undef inside_edges

#define SCENE "docs/exercises/03-inside/scene.json"

typedef enum SlipKind {
    SLIP_NONE,
    SLIP_CROSS,
    SLIP_CORNER,
    SLIP_BACKWARDS,
    SLIP_ONLY_Z,
    SLIP_LAST_EDGE,
    SLIP_FOUR_EDGES,
    SLIP_ZERO_OUTSIDE,
    SLIP_GOES_ON,
    SLIP_NOT_COUNTED,
    SLIP_WRONG_WAY,
    SLIP_COUNT
} SlipKind;

static const char *const SLIPS[SLIP_COUNT] = {
    [SLIP_CROSS] = "the cross product is the wrong way round, c x e for e x c",
    [SLIP_CORNER] = "c is measured from v[0], not from v[k]",
    [SLIP_BACKWARDS] = "the edge e goes backwards, v[k] - v[k+1]",
    [SLIP_ONLY_Z] = "only the z of e x c is looked at, not N.(e x c)",
    [SLIP_LAST_EDGE] = "the last edge, from the last vertex back to v[0], is left out",
    [SLIP_FOUR_EDGES] = "four edges are taken although the face is a triangle",
    [SLIP_ZERO_OUTSIDE] = "a number of 0 counts as outside, as <= does: a point on the edge is inside",
    [SLIP_GOES_ON] = "the loop goes on after the edge that the point is outside of",
    [SLIP_NOT_COUNTED] = "hit->edges is k, not k + 1: it counts the edges, with this one",
    [SLIP_WRONG_WAY] = "inside and outside are the wrong way round",
};

/* As ours, with a slip in it. */
static bool slipped(SlipKind kind, const Face *face, Real3 n, Hit *hit)
{
    bool inside = true;
    int count = face->vertex_count - (kind == SLIP_LAST_EDGE);
    if (kind == SLIP_FOUR_EDGES)
        count = 4;
    for (int k = 0; k < count; k++) {
        Real3 from = vertex(face, k), to = vertex(face, k + 1);
        Real3 e = kind == SLIP_BACKWARDS ? subtract(from, to) : subtract(to, from);
        Real3 c = subtract(hit->p, kind == SLIP_CORNER ? vertex(face, 0) : from);
        Real3 product = kind == SLIP_CROSS ? cross(c, e) : cross(e, c);
        hit->edge[k] = kind == SLIP_ONLY_Z ? product.z : dot(n, product);
        hit->edges = kind == SLIP_NOT_COUNTED ? k : k + 1;
        if (hit->edge[k] < 0 || (kind == SLIP_ZERO_OUTSIDE && hit->edge[k] == 0)) {
            inside = false;
            if (kind != SLIP_GOES_ON)
                break;
        }
    }
    return kind == SLIP_WRONG_WAY ? !inside : inside;
}

/* `formulas` are those of the outcome that is expected. */
static Outcome outcome_of(bool inside, const Hit *hit, const Face *face, Real3 n, bool formulas)
{
    Outcome outcome = {0};
    int edges = hit->edges < 0 ? 0 : hit->edges > 4 ? 4 : hit->edges;
    for (int k = 0; k < 4; k++) {
        add_number(&outcome, (const char *[]){"hit->edge[0]", "hit->edge[1]", "hit->edge[2]", "hit->edge[3]"}[k],
                   k < edges || !formulas ? hit->edge[k] : NAN);
        Real3 e = subtract(vertex(face, k + 1), vertex(face, k)), c = subtract(hit->p, vertex(face, k));
        if (formulas && k < edges)
            add_formula(&outcome, "N.(e x c) = %s.(%s x %s) = %s.%s = %s", text_of(n), text_of(e), text_of(c),
                        text_of(n), text_of(cross(e, c)), number_text(hit->edge[k]));
        else if (formulas)
            add_formula(&outcome, "the edges before decide: this one is not looked at");
    }
    add_integer(&outcome, "hit->edges", hit->edges);
    add_truth(&outcome, "the answer", inside);
    if (formulas && inside)
        add_formula(&outcome, "no N.(e x c) is less than 0: inside");
    else if (formulas)
        add_formula(&outcome, "edge %d has %s < 0: outside", hit->edges - 1, number_text(hit->edge[hit->edges - 1]));
    return outcome;
}

static void try_face(int column, int row, int index)
{
    const Scene *scene = scene_of(SCENE);
    const Face *face = &scene->faces[index];
    Real3 n = normal_of(scene, index);
    RealRay ray = ray_of(scene, column, row);
    Hit start = empty_hit(index);
    start.edges = 0;
    meets_plane(n, vertex(face, 0), ray, &start);
    start.p = add(ray.o, scale(start.t, ray.r));

    shown_at(SCENE, column, row);
    given_face(scene, index);
    given("hit->p", "%s", text_of(start.p));

    Hit returned = start, expected = start;
    bool answer = our_inside_edges(face, n, &expected);
    Outcome ours = outcome_of(answer, &expected, face, n, true);
    bool inside = inside_edges(face, n, &returned);
    for (SlipKind kind = SLIP_NONE + 1; kind < SLIP_COUNT; kind++) {
        Hit hit = start;
        bool slipped_answer = slipped(kind, face, n, &hit);
        Outcome outcome = outcome_of(slipped_answer, &hit, face, n, false);
        slip(&outcome, "%s", SLIPS[kind]);
    }
    Outcome theirs = outcome_of(inside, &returned, face, n, false);
    compare(&theirs, &ours);
}

static void middle_of_a_square(void)
{
    try_face(3, 3, 0);
}

static void right_of_a_square(void)
{
    try_face(6, 3, 0);
}

static void left_of_a_square(void)
{
    try_face(0, 3, 0);
}

static void triangle(void)
{
    try_face(8, 3, 1);
    try_face(11, 2, 1);
}

static void point_on_an_edge(void)
{
    try_face(10, 3, 1);
}

static void face_from_behind(void)
{
    try_face(3, 9, 2);
    try_face(6, 9, 2);
}

static void slope(void)
{
    try_face(11, 8, 3);
    try_face(12, 6, 3);
}

static void every_pixel(void)
{
    const Scene *scene = scene_of(SCENE);
    for (int index = 0; index < scene->face_count; index++)
        for (int row = 0; row < scene->screen.rows; row++)
            for (int column = 0; column < scene->screen.columns; column++)
                try_face(column, row, index);
}

static const ExerciseTest TESTS[] = {
    {"middle_of_a_square", "A point in the middle of a square", middle_of_a_square},
    {"right_of_a_square", "A point to the right of it, outside edge 1", right_of_a_square},
    {"left_of_a_square", "A point to the left of it, outside the last edge only", left_of_a_square},
    {"triangle", "A point in a triangle, and one beside it", triangle},
    {"point_on_an_edge", "A point on an edge of it", point_on_an_edge},
    {"face_from_behind", "A face that is seen from behind, N away from us", face_from_behind},
    {"slope", "A face that leans", slope},
    {"every_pixel", "Every pixel with every face", every_pixel},
    {NULL, NULL, NULL},
};

int main(int argc, char **argv)
{
    Exercise exercise = {.tests = TESTS, .pixel = student_pixel, .scene = SCENE, .columns = 160, .rows = 120};
    return exercise_main(argc, argv, &exercise);
}
