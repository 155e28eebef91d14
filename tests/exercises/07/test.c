/* Exercise 7, mirrors: `mirrored_ray` of the student beside ours. Each test is a mirror on the path of a pixel. */
#include "exercises/textbook.h"

/* Ours, under another name. */
#define mirrored_ray our_mirrored_ray
#undef RECTRAY_TEXTBOOK_MIRROR_H
#include "src/trace/textbook_mirror.h"
#undef mirrored_ray

#define SCENE "docs/exercises/07-mirror/scene.json"

typedef enum SlipKind {
    SLIP_NONE,
    SLIP_ONCE,
    SLIP_PLUS,
    SLIP_BACK,
    SLIP_AROUND_NORMAL,
    SLIP_ALONG_R,
    SLIP_NO_COSINE,
    SLIP_STRAIGHT_ON,
    SLIP_FROM_P,
    SLIP_COUNT
} SlipKind;

static const char *const SLIPS[SLIP_COUNT] = {
    [SLIP_ONCE] = "(r.N) N is taken away once, not twice: the ray runs along the mirror",
    [SLIP_PLUS] = "2 (r.N) N is added, not taken away: the ray goes through the mirror",
    [SLIP_BACK] = "the ray goes back where it came from, -r",
    [SLIP_AROUND_NORMAL] = "r' is 2 (r.N) N - r: that turns the way to a light round, not the way of a ray",
    [SLIP_ALONG_R] = "r and N are exchanged: (r.N) r for (r.N) N",
    [SLIP_NO_COSINE] = "2 N is taken away, whatever r.N",
    [SLIP_STRAIGHT_ON] = "the direction stays r",
    [SLIP_FROM_P] = "the ray starts at P, not at the shifted point",
};

/* As ours, with a slip in it. */
static RealRay slipped(SlipKind kind, Real3 r, const Hit *hit)
{
    Real cosine = dot(r, hit->n);
    Real3 away = scale(2 * cosine, hit->n);
    Real3 direction = subtract(r, away);
    if (kind == SLIP_ONCE)
        direction = subtract(r, scale(cosine, hit->n));
    if (kind == SLIP_PLUS)
        direction = add(r, away);
    if (kind == SLIP_BACK)
        direction = scale(-1, r);
    if (kind == SLIP_AROUND_NORMAL)
        direction = subtract(away, r);
    if (kind == SLIP_ALONG_R)
        direction = subtract(r, scale(2 * cosine, r));
    if (kind == SLIP_NO_COSINE)
        direction = subtract(r, scale(2, hit->n));
    if (kind == SLIP_STRAIGHT_ON)
        direction = r;
    return (RealRay){kind == SLIP_FROM_P ? hit->p : hit->shifted, direction};
}

static Outcome outcome_of(RealRay ray)
{
    Outcome outcome = {0};
    add_vector(&outcome, "ray.o", doubles(ray.o));
    add_vector(&outcome, "ray.r", doubles(ray.r));
    return outcome;
}

/* The ray that arrives at mirror number `bounce` on the pixel's path. Gives false where there is no such mirror. */
static bool arrive(const Textbook *textbook, int column, int row, int bounce, RealRay *ray, Hit *hit)
{
    const Scene *scene = textbook->scene;
    *ray = ray_of(scene, column, row);
    for (;; bounce--) {
        *hit = nearest_hit(textbook, *ray);
        if (hit->face < 0 || scene->materials[scene->faces[hit->face].material].reflection == 0)
            return false;
        place_hit(textbook, hit);
        if (bounce == 0)
            return true;
        *ray = our_mirrored_ray(unit(ray->r), hit);
    }
}

static void try_mirror(int column, int row, int bounce)
{
    Textbook textbook = textbook_of(scene_of(SCENE));
    RealRay ray;
    Hit hit;
    if (!arrive(&textbook, column, row, bounce, &ray, &hit))
        return;
    Real3 r = unit(ray.r);
    shown_with(SCENE, column, row, "--arithmetic textbook --precision double");
    given("mirror", "P%d on the path, face %d, %s", bounce + 1, hit.face,
          textbook.scene->objects[textbook.scene->faces[hit.face].object].name);
    given("r", "%s", text_of(r));
    given("hit->n", "%s", text_of(hit.n));
    given("hit->p", "%s", text_of(hit.p));
    given("hit->shifted", "%s", text_of(hit.shifted));

    RealRay returned = mirrored_ray(r, &hit), expected = our_mirrored_ray(r, &hit);
    for (SlipKind kind = SLIP_NONE + 1; kind < SLIP_COUNT; kind++) {
        Outcome outcome = outcome_of(slipped(kind, r, &hit));
        slip(&outcome, "%s", SLIPS[kind]);
    }
    Outcome theirs = outcome_of(returned), ours = {0};
    add_vector(&ours, "ray.o", doubles(expected.o));
    add_formula(&ours, "the ray starts at S = %s", text_of(hit.shifted));
    add_vector(&ours, "ray.r", doubles(expected.r));
    add_formula(&ours, "r.N = %s, r' = r - 2 (r.N) N = %s - 2 x %s %s = %s", number_text(dot(r, hit.n)), text_of(r),
                number_text(dot(r, hit.n)), text_of(hit.n), text_of(expected.r));
    compare(&theirs, &ours);
}

static void straight_on(void)
{
    try_mirror(4, 3, 0);
}

static void mirror_ahead(void)
{
    try_mirror(3, 2, 0);
    try_mirror(5, 4, 0);
}

static void floor_below(void)
{
    try_mirror(5, 6, 0);
}

static void turned_mirror(void)
{
    try_mirror(7, 3, 0);
}

static void mirror_in_a_mirror(void)
{
    for (int row = 0; row < 7; row++)
        for (int column = 0; column < 9; column++)
            try_mirror(column, row, 1);
}

static void every_pixel(void)
{
    for (int row = 0; row < 7; row++)
        for (int column = 0; column < 9; column++)
            for (int bounce = 0; bounce < 3; bounce++)
                try_mirror(column, row, bounce);
}

static const ExerciseTest TESTS[] = {
    {"straight_on", "A ray straight on to a mirror", straight_on},
    {"mirror_ahead", "The mirror ahead, at an angle", mirror_ahead},
    {"floor_below", "The floor", floor_below},
    {"turned_mirror", "A mirror that is turned to the side", turned_mirror},
    {"mirror_in_a_mirror", "A mirror that is seen in a mirror", mirror_in_a_mirror},
    {"every_pixel", "Every mirror on the path of every pixel", every_pixel},
    {NULL, NULL, NULL},
};

int main(int argc, char **argv)
{
    Exercise exercise = {.tests = TESTS, .pixel = student_pixel, .scene = SCENE, .columns = 135, .rows = 105};
    return exercise_main(argc, argv, &exercise);
}
