/* Exercise 4, the nearest face: `nearest_hit` of the student beside ours. Each test is a pixel of the scene. */
#include "exercises/textbook.h"

#include <string.h>

/* Ours, under another name. */
#define nearest_hit our_nearest_hit
#undef RECTRAY_TEXTBOOK_NEAREST_H
#include "src/trace/textbook_nearest.h"
#undef nearest_hit

#define SCENE "docs/exercises/04-nearest/scene.json"

typedef enum SlipKind {
    SLIP_NONE,
    SLIP_LAST,
    SLIP_FIRST,
    SLIP_FARTHEST,
    SLIP_TIE,
    SLIP_NO_ASKING,
    SLIP_TO_SCREEN,
    SLIP_NO_LAST_FACE,
    SLIP_NO_FIRST_FACE,
    SLIP_ONLY_FACE,
    SLIP_BEHIND,
    SLIP_COUNT
} SlipKind;

static const char *const SLIPS[SLIP_COUNT] = {
    [SLIP_LAST] = "the last face of the file that is hit is kept, whatever its t",
    [SLIP_FIRST] = "the search ends at the first face that is hit",
    [SLIP_FARTHEST] = "the largest t is kept, not the smallest",
    [SLIP_TIE] = "of faces with the same t the last one is kept, as <= does; the first one counts",
    [SLIP_NO_ASKING] = "what hits_face answers is not looked at: a plane counts even outside of the face",
    [SLIP_TO_SCREEN] = "the search starts with t = 1, so that nothing behind the screen is found",
    [SLIP_NO_LAST_FACE] = "the last face of the scene is left out",
    [SLIP_NO_FIRST_FACE] = "face 0 is left out: faces are counted from 0",
    [SLIP_ONLY_FACE] = "only face and t of the nearest hit are kept; all of it is to be copied",
    [SLIP_BEHIND] = "the search starts with t = 0, so that nothing is nearer",
};

/* As ours, with a slip in it. */
static Hit slipped(SlipKind kind, const Textbook *textbook, RealRay ray)
{
    Hit nearest = empty_hit(-1);
    nearest.t = kind == SLIP_TO_SCREEN ? 1 : kind == SLIP_BEHIND || kind == SLIP_FARTHEST ? 0 : HUGE_VAL;
    int count = textbook->scene->face_count;
    for (int i = kind == SLIP_NO_FIRST_FACE; i < count - (kind == SLIP_NO_LAST_FACE); i++) {
        Hit hit = {.t = NOTHING};
        bool found = hits(textbook->scene, i, &ray, &hit) || (kind == SLIP_NO_ASKING && hit.t > 0);
        bool nearer = hit.t < nearest.t;
        if (kind == SLIP_LAST)
            nearer = true;
        if (kind == SLIP_FIRST)
            nearer = nearest.face < 0;
        if (kind == SLIP_FARTHEST)
            nearer = hit.t > nearest.t;
        if (kind == SLIP_TIE)
            nearer = hit.t <= nearest.t;
        if (found && nearer) {
            Hit before = nearest;
            nearest = hit;
            if (kind == SLIP_ONLY_FACE)
                nearest.p = before.p;
        }
    }
    return nearest;
}

/* Where no face is hit, only that counts. */
static Outcome outcome_of(const Hit *hit, int faces)
{
    Outcome outcome = {0};
    bool is_face = hit->face >= 0 && hit->face < faces;
    add_integer(&outcome, "the face", hit->face);
    add_number(&outcome, "its t", is_face ? hit->t : NAN);
    add_vector(&outcome, "its p", is_face ? doubles(hit->p) : vec3(NAN, NAN, NAN));
    add_number(&outcome, "its n_dot_r", is_face ? hit->n_dot_r : NAN);
    return outcome;
}

/* "t = 2.5 of face 0 (wall), 0.5 of face 1 (near card)". */
static void describe_hits(const Scene *scene, RealRay ray, char *text, size_t size)
{
    text[0] = 0;
    for (int i = 0; i < scene->face_count; i++) {
        Hit hit;
        if (!hits(scene, i, &ray, &hit))
            continue;
        size_t used = strlen(text);
        snprintf(text + used, size - used, "%s%s of face %d (%s)", used ? ", " : "t = ", number_text(hit.t), i,
                 scene->objects[scene->faces[i].object].name);
    }
    if (!text[0])
        snprintf(text, size, "no face is hit, so the face is -1");
}

static void try_pixel(int column, int row)
{
    const Scene *scene = scene_of(SCENE);
    Textbook textbook = textbook_of(scene);
    RealRay ray = ray_of(scene, column, row);
    shown_at(SCENE, column, row);
    given_ray(ray);
    given("faces", "%d", scene->face_count);

    Hit returned = nearest_hit(&textbook, ray);
    Hit expected = our_nearest_hit(&textbook, ray);
    for (SlipKind kind = SLIP_NONE + 1; kind < SLIP_COUNT; kind++) {
        Hit hit = slipped(kind, &textbook, ray);
        Outcome outcome = outcome_of(&hit, scene->face_count);
        slip(&outcome, "%s", SLIPS[kind]);
    }
    char text[EXERCISE_TEXT];
    describe_hits(scene, ray, text, sizeof text);
    Outcome theirs = outcome_of(&returned, scene->face_count), ours = outcome_of(&expected, scene->face_count);
    for (int k = 0; k < ours.count; k++)
        memcpy(ours.values[k].formula, text, sizeof text);
    compare(&theirs, &ours);
}

static void one_face(void)
{
    try_pixel(1, 3);
}

static void nothing(void)
{
    try_pixel(3, 0);
}

static void near_and_far(void)
{
    try_pixel(2, 5);
    try_pixel(9, 8);
}

static void three_faces(void)
{
    try_pixel(5, 7);
}

static void last_face(void)
{
    try_pixel(13, 9);
}

static void twins(void)
{
    try_pixel(12, 3);
}

static void every_pixel(void)
{
    const Scene *scene = scene_of(SCENE);
    for (int row = 0; row < scene->screen.rows; row++)
        for (int column = 0; column < scene->screen.columns; column++)
            try_pixel(column, row);
}

static const ExerciseTest TESTS[] = {
    {"one_face", "A ray that hits one face", one_face},
    {"nothing", "A ray that hits none", nothing},
    {"near_and_far", "A ray that hits a card before a wall", near_and_far},
    {"three_faces", "A ray that hits three", three_faces},
    {"last_face", "A ray to the last face of the scene", last_face},
    {"twins", "Two faces in one place, with the same t", twins},
    {"every_pixel", "Every pixel", every_pixel},
    {NULL, NULL, NULL},
};

int main(int argc, char **argv)
{
    Exercise exercise = {.tests = TESTS, .pixel = student_pixel, .scene = SCENE, .columns = 128, .rows = 96};
    return exercise_main(argc, argv, &exercise);
}
