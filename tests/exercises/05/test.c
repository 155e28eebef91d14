/* Exercise 5, shadows: `place_hit` and `face_between` of the student beside ours. Each test is a pixel of the scene and
 * one of its lights. */
#include "exercises/textbook.h"

/* Ours, under other names. */
#define place_hit our_place_hit
#define face_between our_face_between
#undef RECTRAY_TEXTBOOK_SHADOW_H
#include "src/trace/textbook_shadow.h"
#undef place_hit
#undef face_between

#define SCENE "docs/exercises/05-shadow/scene.json"

/* So that the numbers of S are those of the exercise. */
#define OPTIONS "--arithmetic textbook --precision double -v"

typedef enum SlipKind {
    SLIP_NONE,
    /* of place_hit */
    SLIP_NOT_TURNED,
    SLIP_TURNED_AWAY,
    SLIP_INTO_THE_FACE,
    SLIP_NO_SHIFT,
    SLIP_ALONG_FACE_NORMAL,
    SLIP_UNIT_SHIFT,
    PLACE_SLIPS,
    /* of face_between */
    SLIP_FROM_P = PLACE_SLIPS,
    SLIP_NO_END,
    SLIP_BEYOND,
    SLIP_BACKWARDS,
    SLIP_UNIT,
    SLIP_LIGHT_AS_DIRECTION,
    SLIP_ONLY_FIRST,
    SLIP_LAST,
    SLIP_YES,
    SLIP_COUNT
} SlipKind;

static const char *const SLIPS[SLIP_COUNT] = {
    [SLIP_NOT_TURNED] = "the normal is not turned to the side that the ray came from",
    [SLIP_TURNED_AWAY] = "the normal is turned where N.R < 0, not where N.R > 0",
    [SLIP_INTO_THE_FACE] = "the point is shifted against the normal, into the face",
    [SLIP_NO_SHIFT] = "the point is not shifted at all",
    [SLIP_ALONG_FACE_NORMAL] = "the point is shifted along N, not along the turned normal",
    [SLIP_UNIT_SHIFT] = "the point is shifted by 1, not by textbook->shift",
    [SLIP_FROM_P] = "the shadow ray starts at P, not at the shifted point: a face may then shadow itself",
    [SLIP_NO_END] = "the shadow ray does not stop at the light: a face at t >= 1 is beyond it",
    [SLIP_BEYOND] = "only faces beyond the light count, t > 1",
    [SLIP_BACKWARDS] = "the shadow ray goes away from the light: R = S - light",
    [SLIP_UNIT] = "R is made a unit vector, so that t = 1 is not the light any more",
    [SLIP_LIGHT_AS_DIRECTION] = "the light's position is taken for the direction, not light - S",
    [SLIP_ONLY_FIRST] = "the answer is given after the first face: only the last one tells that nothing is between",
    [SLIP_LAST] = "of several faces in the way the last one is given back, not the first in the file",
    [SLIP_YES] = "1 is given back where a face is in the way, not the number of that face",
};

/* As ours, with a slip in it. */
static void place_slipped(SlipKind kind, const Textbook *textbook, Hit *hit)
{
    Real3 n = normal_of(textbook->scene, hit->face);
    bool turned = kind == SLIP_TURNED_AWAY ? hit->n_dot_r < 0 : hit->n_dot_r > 0;
    hit->n = turned && kind != SLIP_NOT_TURNED ? scale(-1, n) : n;
    Real shift = kind == SLIP_INTO_THE_FACE ? -textbook->shift
                 : kind == SLIP_NO_SHIFT    ? 0
                 : kind == SLIP_UNIT_SHIFT  ? 1
                                            : textbook->shift;
    hit->shifted = add(hit->p, scale(shift, kind == SLIP_ALONG_FACE_NORMAL ? n : hit->n));
}

/* As ours, with a slip in it. */
static int between_slipped(SlipKind kind, const Textbook *textbook, const Hit *hit, Real3 light)
{
    Real3 from = kind == SLIP_FROM_P ? hit->p : hit->shifted;
    Real3 r = kind == SLIP_LIGHT_AS_DIRECTION ? light : subtract(light, from);
    if (kind == SLIP_BACKWARDS)
        r = scale(-1, r);
    if (kind == SLIP_UNIT)
        r = unit(r);
    int last = -1;
    for (int i = 0; i < textbook->scene->face_count; i++) {
        Hit between;
        bool found = hits(textbook->scene, i, &(RealRay){from, r}, &between);
        bool counts = kind == SLIP_NO_END || (kind == SLIP_BEYOND ? between.t > 1 : between.t < 1);
        if (found && counts && kind == SLIP_YES)
            return 1;
        if (found && counts && kind != SLIP_LAST)
            return i;
        if (kind == SLIP_ONLY_FIRST)
            return -1;
        if (found && counts)
            last = i;
    }
    return last;
}

/* What the pixel's ray hits first, not yet placed. */
static Hit hit_of(const Textbook *textbook, int column, int row)
{
    Hit hit = nearest_hit(textbook, ray_of(textbook->scene, column, row)), nothing = empty_hit(0);
    hit.n = hit.shifted = nothing.p;
    return hit;
}

static void given_hit(const Scene *scene, const Hit *hit)
{
    given("hit->face", "%d, %s", hit->face, scene->objects[scene->faces[hit->face].object].name);
    given("hit->p", "%s", text_of(hit->p));
    given("hit->n_dot_r", "%s", number_text(hit->n_dot_r));
}

static Outcome placed_of(const Hit *hit)
{
    Outcome outcome = {0};
    add_vector(&outcome, "hit->n", doubles(hit->n));
    add_vector(&outcome, "hit->shifted", doubles(hit->shifted));
    return outcome;
}

static void try_place(int column, int row)
{
    Textbook textbook = textbook_of(scene_of(SCENE));
    Hit start = hit_of(&textbook, column, row), returned = start, expected = start;
    shown_with(SCENE, column, row, OPTIONS);
    given_hit(textbook.scene, &start);
    given("N", "%s", text_of(normal_of(textbook.scene, start.face)));
    given("shift", "%s", number_text((double)textbook.shift));

    place_hit(&textbook, &returned);
    our_place_hit(&textbook, &expected);
    for (SlipKind kind = SLIP_NONE + 1; kind < PLACE_SLIPS; kind++) {
        Hit hit = start;
        place_slipped(kind, &textbook, &hit);
        Outcome outcome = placed_of(&hit);
        slip(&outcome, "%s", SLIPS[kind]);
    }
    Outcome theirs = placed_of(&returned), ours = {0};
    add_vector(&ours, "hit->n", doubles(expected.n));
    add_formula(&ours, "N.R = %s %s 0, so n = %s = %s", number_text(start.n_dot_r), start.n_dot_r > 0 ? ">" : "<",
                start.n_dot_r > 0 ? "-N" : "N", text_of(expected.n));
    add_vector(&ours, "hit->shifted", doubles(expected.shifted));
    add_formula(&ours, "S = P + shift n = %s + %s %s = %s", text_of(start.p), number_text((double)textbook.shift),
                text_of(expected.n), text_of(expected.shifted));
    compare(&theirs, &ours);
}

/* Why our answer is right, and what the student's face has to say. */
static void explain(Outcome *outcome, const Textbook *textbook, RealRay ray, int expected, int returned)
{
    const Scene *scene = textbook->scene;
    Hit ours, theirs;
    if (expected >= 0)
        hits(scene, expected, &ray, &ours);
    if (returned >= 0 && returned < scene->face_count && hits(scene, returned, &ray, &theirs) && theirs.t >= 1)
        add_formula(outcome, "face %d is hit at t = %s: beyond the light, which is at t = 1", returned,
                    number_text(theirs.t));
    else if (expected >= 0)
        add_formula(outcome, "S + t (light - S) with light - S = %s hits face %d, %s, at t = %s: 0 < t < 1",
                    text_of(ray.r), expected, scene->objects[scene->faces[expected].object].name, number_text(ours.t));
    else
        add_formula(outcome, "S + t (light - S) with light - S = %s hits no face at 0 < t < 1, so -1", text_of(ray.r));
}

static void try_light(int column, int row, int index)
{
    const Scene *scene = scene_of(SCENE);
    Textbook textbook = textbook_of(scene);
    Hit hit = hit_of(&textbook, column, row);
    our_place_hit(&textbook, &hit);
    Real3 light = rounded(scene->lights[index].position);
    shown_with(SCENE, column, row, OPTIONS);
    given_hit(scene, &hit);
    given("hit->shifted", "%s", text_of(hit.shifted));
    given("light", "%s", text_of(light));

    int returned = face_between(&textbook, &hit, light), expected = our_face_between(&textbook, &hit, light);
    for (SlipKind kind = PLACE_SLIPS; kind < SLIP_COUNT; kind++) {
        Outcome outcome = {0};
        add_integer(&outcome, "the face", between_slipped(kind, &textbook, &hit, light));
        slip(&outcome, "%s", SLIPS[kind]);
    }
    Outcome theirs = {0}, ours = {0};
    add_integer(&theirs, "the face", returned);
    add_integer(&ours, "the face", expected);
    explain(&ours, &textbook, (RealRay){hit.shifted, subtract(light, hit.shifted)}, expected, returned);
    compare(&theirs, &ours);
}

static void normal_towards_us(void)
{
    try_place(9, 10);
    try_place(4, 8);
}

static void normal_away_from_us(void)
{
    try_place(5, 3);
}

static void nothing_between(void)
{
    try_light(9, 10, 1);
}

static void face_between_them(void)
{
    try_light(4, 9, 0);
    try_light(8, 5, 1);
}

static void face_beyond_the_light(void)
{
    try_light(9, 10, 0);
}

static void two_faces_between(void)
{
    try_light(5, 10, 0);
}

static void face_of_the_point(void)
{
    for (int column = 3; column < 6; column++) {
        try_light(column, 8, 0);
        try_light(column, 8, 1);
    }
    for (int row = 5; row < 10; row++)
        try_light(10, row, 1);
}

static void every_pixel(void)
{
    Textbook textbook = textbook_of(scene_of(SCENE));
    for (int row = 0; row < textbook.scene->screen.rows; row++)
        for (int column = 0; column < textbook.scene->screen.columns; column++)
            if (hit_of(&textbook, column, row).face >= 0) {
                try_place(column, row);
                try_light(column, row, 0);
                try_light(column, row, 1);
            }
}

static const ExerciseTest TESTS[] = {
    {"normal_towards_us", "place_hit: a face whose normal points to us", normal_towards_us},
    {"normal_away_from_us", "place_hit: a wall whose normal points away from us", normal_away_from_us},
    {"nothing_between", "face_between: nothing is between", nothing_between},
    {"face_beyond_the_light", "face_between: a face beyond the light", face_beyond_the_light},
    {"face_between_them", "face_between: a face is between", face_between_them},
    {"two_faces_between", "face_between: two faces are between", two_faces_between},
    {"face_of_the_point", "face_between: a face does not shadow itself", face_of_the_point},
    {"every_pixel", "Every pixel, and both lights", every_pixel},
    {NULL, NULL, NULL},
};

int main(int argc, char **argv)
{
    Exercise exercise = {.tests = TESTS, .pixel = student_pixel, .scene = SCENE, .columns = 128, .rows = 96};
    return exercise_main(argc, argv, &exercise);
}
