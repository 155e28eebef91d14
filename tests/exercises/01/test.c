/* Exercise 1, camera and screen: `camera_ray` of the student beside ours. Each test is a sample of a pixel. */
#include "exercises/textbook.h"

/* Ours, under another name. */
#define camera_ray our_camera_ray
#undef RECTRAY_TEXTBOOK_CAMERA_H
#include "src/trace/textbook_camera.h"
#undef camera_ray

#define SCENE "docs/exercises/01-camera/scene.json"
#define LEANING "docs/exercises/01-camera/leaning.json"

typedef enum SlipKind {
    SLIP_NONE,
    SLIP_NO_HALF,
    SLIP_UPSIDE_DOWN,
    SLIP_LEFT_RIGHT,
    SLIP_WIDTH_FOR_HEIGHT,
    SLIP_WHOLE_NUMBERS,
    SLIP_NO_SAMPLES,
    SLIP_SAMPLES_SWAPPED,
    SLIP_SAMPLES_APART,
    SLIP_POINT,
    SLIP_NO_FORWARD,
    SLIP_UNIT,
    SLIP_UP_FOR_RIGHT,
    SLIP_COUNT
} SlipKind;

static const char *const SLIPS[SLIP_COUNT] = {
    [SLIP_NO_HALF] = "the ray goes through the corner of the pixel: the 0.5 after i and j is missing",
    [SLIP_UPSIDE_DOWN] = "y grows downwards: row 0 is at the top, where y is largest",
    [SLIP_LEFT_RIGHT] = "x grows to the left",
    [SLIP_WIDTH_FOR_HEIGHT] = "y is scaled by the width of the screen, not by its height",
    [SLIP_WHOLE_NUMBERS] = "column / columns is a division of whole numbers, which gives 0",
    [SLIP_NO_SAMPLES] = "i and j are not used, so all samples of a pixel are its middle",
    [SLIP_SAMPLES_SWAPPED] = "i and j are exchanged: i goes along the row, j down",
    [SLIP_SAMPLES_APART] = "i + 0.5 and j + 0.5 are not divided by the grid",
    [SLIP_POINT] = "r is the point Q, not Q - C",
    [SLIP_NO_FORWARD] = "the way forward is missing from r",
    [SLIP_UNIT] = "r is made a unit vector; it ends on the screen, whatever its length",
    [SLIP_UP_FOR_RIGHT] = "x goes along up, and y along right",
};

/* As ours, with a slip in it. */
static ScreenRay slipped(SlipKind kind, View view, int column, int row, int i, int j)
{
    Real half = kind == SLIP_NO_HALF ? 0 : 0.5, n = view.grid;
    Real across = (i + half) / n, down = (j + half) / n;
    if (kind == SLIP_NO_SAMPLES)
        across = down = half;
    if (kind == SLIP_SAMPLES_APART) {
        across = i + half;
        down = j + half;
    }
    if (kind == SLIP_SAMPLES_SWAPPED) {
        Real other = across;
        across = down;
        down = other;
    }
    Real u = (column + across) / view.columns, v = (row + down) / view.rows;
    if (kind == SLIP_WHOLE_NUMBERS) {
        u = floor(u);
        v = floor(v);
    }
    ScreenRay sample = {.x = (u - 0.5) * view.width, .y = (0.5 - v) * view.height};
    if (kind == SLIP_WIDTH_FOR_HEIGHT)
        sample.y = (0.5 - v) * view.width;
    if (kind == SLIP_UPSIDE_DOWN)
        sample.y = -sample.y;
    if (kind == SLIP_LEFT_RIGHT)
        sample.x = -sample.x;
    Real3 right = rounded(view.right), up = rounded(view.up);
    if (kind == SLIP_UP_FOR_RIGHT) {
        right = rounded(view.up);
        up = rounded(view.right);
    }
    Real3 r = add(scale(sample.x, right), scale(sample.y, up));
    if (kind != SLIP_NO_FORWARD)
        r = add(rounded(view.forward), r);
    if (kind == SLIP_POINT)
        r = add(rounded(view.eye), r);
    if (kind == SLIP_UNIT)
        r = unit(r);
    sample.ray = (RealRay){rounded(view.eye), r};
    return sample;
}

static Outcome outcome_of(ScreenRay sample)
{
    Outcome outcome = {0};
    add_number(&outcome, "x", sample.x);
    add_number(&outcome, "y", sample.y);
    add_vector(&outcome, "ray.o", doubles(sample.ray.o));
    add_vector(&outcome, "ray.r", doubles(sample.ray.r));
    return outcome;
}

/* Ours, with the formulas. */
static Outcome expected_of(View view, int column, int row, int i, int j)
{
    ScreenRay sample = our_camera_ray(view, column, row, i, j);
    Outcome outcome = {0};
    add_number(&outcome, "x", sample.x);
    add_formula(&outcome, "x = ((column + (i + 0.5)/n)/columns - 0.5) width = ((%d + (%d + 0.5)/%d)/%d - 0.5) %s = %s",
                column, i, view.grid, view.columns, number_text(view.width), number_text(sample.x));
    add_number(&outcome, "y", sample.y);
    add_formula(&outcome, "y = (0.5 - (row + (j + 0.5)/n)/rows) height = (0.5 - (%d + (%d + 0.5)/%d)/%d) %s = %s", row,
                j, view.grid, view.rows, number_text(view.height), number_text(sample.y));
    add_vector(&outcome, "ray.o", doubles(sample.ray.o));
    add_formula(&outcome, "the ray starts at the camera, C = %s", vector_text(view.eye));
    add_vector(&outcome, "ray.r", doubles(sample.ray.r));
    add_formula(&outcome, "R = forward + x right + y up = %s + %s %s + %s %s = %s", vector_text(view.forward),
                number_text(sample.x), vector_text(view.right), number_text(sample.y), vector_text(view.up),
                text_of(sample.ray.r));
    return outcome;
}

static ScreenRay empty_ray(void)
{
    Hit hit = empty_hit(0);
    return (ScreenRay){NOTHING, NOTHING, {hit.p, hit.p}};
}

static void try_sample(const char *path, int grid, int column, int row, int i, int j)
{
    View view = view_of(scene_of(path));
    view.grid = grid;
    char options[60];
    snprintf(options, sizeof options, grid > 1 ? "--grid %d --sample %d,%d" : "", grid, i, j);
    shown_with(path, column, row, options);
    given("column, row", "%d, %d", column, row);
    given("i, j", "%d, %d", i, j);
    given("columns, rows", "%d, %d", view.columns, view.rows);
    given("n", "%d, the grid", view.grid);
    given("width, height", "%s, %s", number_text(view.width), number_text(view.height));
    given("eye", "%s", vector_text(view.eye));
    given("forward", "%s", vector_text(view.forward));
    given("right", "%s", vector_text(view.right));
    given("up", "%s", vector_text(view.up));

    ScreenRay returned = empty_ray();
    returned = camera_ray(view, column, row, i, j);
    for (SlipKind kind = SLIP_NONE + 1; kind < SLIP_COUNT; kind++) {
        Outcome outcome = outcome_of(slipped(kind, view, column, row, i, j));
        slip(&outcome, "%s", SLIPS[kind]);
    }
    Outcome theirs = outcome_of(returned), ours = expected_of(view, column, row, i, j);
    compare(&theirs, &ours);
}

static void middle_of_the_picture(void)
{
    try_sample(SCENE, 1, 4, 3, 0, 0);
}

static void pixel_to_the_right(void)
{
    try_sample(SCENE, 1, 5, 3, 0, 0);
}

static void pixel_above(void)
{
    try_sample(SCENE, 1, 4, 2, 0, 0);
}

static void corners(void)
{
    try_sample(SCENE, 1, 0, 0, 0, 0);
    try_sample(SCENE, 1, 8, 6, 0, 0);
}

static void samples_of_a_pixel(void)
{
    try_sample(SCENE, 2, 3, 4, 0, 0);
    try_sample(SCENE, 2, 3, 4, 1, 0);
    try_sample(SCENE, 2, 3, 4, 0, 1);
}

static void camera_that_leans(void)
{
    try_sample(LEANING, 1, 2, 6, 0, 0);
    try_sample(LEANING, 3, 7, 1, 2, 0);
}

static void every_pixel(void)
{
    const Screen *screen = &scene_of(LEANING)->screen;
    for (int row = 0; row < screen->rows; row++)
        for (int column = 0; column < screen->columns; column++)
            try_sample(LEANING, 2, column, row, (column + row) % 2, row % 2);
}

static const ExerciseTest TESTS[] = {
    {"middle_of_the_picture", "The pixel in the middle: straight ahead", middle_of_the_picture},
    {"pixel_to_the_right", "The pixel to the right of it", pixel_to_the_right},
    {"pixel_above", "The pixel above it", pixel_above},
    {"corners", "The pixels in two corners", corners},
    {"samples_of_a_pixel", "Samples of a pixel that has 2 x 2", samples_of_a_pixel},
    {"camera_that_leans", "A camera that leans, and pixels that are not square", camera_that_leans},
    {"every_pixel", "Every pixel of it", every_pixel},
    {NULL, NULL, NULL},
};

int main(int argc, char **argv)
{
    Exercise exercise = {.tests = TESTS, .pixel = student_pixel, .scene = LEANING, .columns = 150, .rows = 120};
    return exercise_main(argc, argv, &exercise);
}
