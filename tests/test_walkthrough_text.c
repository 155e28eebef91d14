/* The walkthrough as text, for every pixel of the scenes that take every branch: no line is too long, no number is
 * ugly, and the last line states the pixel. */
#include "reader/scene_json.h"
#include "unity.h"
#include "walkthrough/walkthrough_formats.h"
#include "walkthrough/walkthrough_summary.h"

#include <stdlib.h>
#include <string.h>

static Scene scene;
static Accel accel;
static Error error;
static Walkthrough walk;
static char *text;

void setUp(void) {}

void tearDown(void)
{
    free(text);
    text = NULL;
    walkthrough_free(&walk);
    accel_free(&accel);
    scene_free(&scene);
}

static void load(const char *path, AccelKind kind)
{
    error = (Error){.kind = ERROR_NONE};
    accel_free(&accel);
    scene_free(&scene);
    TEST_ASSERT_TRUE_MESSAGE(scene_load(&scene, path, &error), error.text);
    TEST_ASSERT_TRUE_MESSAGE(accel_build(&accel, &scene, kind, 1, &error), error.text);
}

static void write_styled(WalkthroughRequest request, WalkthroughStyle style)
{
    size_t size = 0;
    free(text);
    text = NULL;
    walkthrough_free(&walk);
    TEST_ASSERT_TRUE_MESSAGE(walkthrough_record(&walk, &scene, &accel, "scene.json", request, &error), error.text);
    TEST_ASSERT_TRUE(walkthrough_look_around(&walk, &error));
    FILE *out = open_memstream(&text, &size);
    TEST_ASSERT_NOT_NULL(out);
    TEST_ASSERT_TRUE(walkthrough_write_text(out, &walk, style, &error));
    TEST_ASSERT_EQUAL_INT(0, fclose(out));
}

static void write_text(WalkthroughRequest request, InkColour colour)
{
    write_styled(request, (WalkthroughStyle){.colour = colour});
}

static int count_lines(void)
{
    int lines = 0;
    for (const char *c = text; *c; c++)
        lines += *c == '\n';
    return lines;
}

static void check_lines(size_t columns, const char *message)
{
    for (const char *line = text; *line;) {
        size_t length = strcspn(line, "\n");
        TEST_ASSERT_LESS_OR_EQUAL_MESSAGE(columns, length, message); /* the names are ASCII */
        TEST_ASSERT_TRUE_MESSAGE(length == 0 || line[length - 1] != ' ', message);
        line += length + 1;
    }
    static const char *const ugly[] = {"nan", "inf", "(-0,", " -0,", " -0)", "%"};
    for (int i = 0; i < 6; i++)
        TEST_ASSERT_NULL_MESSAGE(strstr(text, ugly[i]), message);
}

static void check_last_line(WalkthroughRequest request, const char *message)
{
    char expected[64];
    const unsigned char *rgb = walk.events[walk.count - 1].as.pixel.rgb;
    snprintf(expected, sizeof expected, "\nPixel (%d, %d) = (%d, %d, %d)\n", request.column, request.row, rgb[0],
             rgb[1], rgb[2]);
    size_t length = strlen(text), tail = strlen(expected);
    TEST_ASSERT_TRUE_MESSAGE(length > tail, message);
    TEST_ASSERT_EQUAL_STRING_MESSAGE(expected, text + length - tail, message);
}

static void text_should_be_tidy_and_end_with_the_pixel(void)
{
    static const char *const names[] = {"black", "ambient", "dark", "empty"};
    for (int k = 0; k < 16; k++) {
        char path[64], message[160];
        snprintf(path, sizeof path, "tests/scenes/walkthrough/%s.json", names[k / 4]);
        load(path, k % 4 < 2 ? ACCEL_NONE : ACCEL_BVH);
        for (int p = 0; p < scene.screen.columns * scene.screen.rows; p++) {
            WalkthroughRequest request = {p % scene.screen.columns, p / scene.screen.columns, 0, 0, k % 2};
            snprintf(message, sizeof message, "rectray trace %s --pixel %d,%d%s%s", path, request.column, request.row,
                     k % 4 < 2 ? "" : " --accel bvh", k % 2 ? " --verbose" : "");
            write_text(request, INK_PLAIN);
            check_lines(INK_COLUMNS, message);
            check_last_line(request, message);
        }
    }
}

/* The summary and the steps in terminals of several widths. */
static void text_should_keep_to_the_width_that_is_asked_for(void)
{
    static const char *const names[] = {"black", "ambient", "dark", "empty", "refined"};
    static const int widths[] = {80, 81, 120, 160};
    for (int k = 0; k < 5 * 4; k++) {
        char path[64], message[160];
        snprintf(path, sizeof path, "tests/scenes/walkthrough/%s.json", names[k / 4]);
        load(path, k % 2 ? ACCEL_KDTREE : ACCEL_BVH);
        for (int p = k % 4; p < scene.screen.columns * scene.screen.rows; p += 4) {
            WalkthroughRequest request = {p % scene.screen.columns, p / scene.screen.columns, 0, 0, k % 3 == 0};
            snprintf(message, sizeof message, "rectray trace %s --pixel %d,%d --width %d --accel %s%s", path,
                     request.column, request.row, widths[k % 4], k % 2 ? "kdtree" : "bvh", k % 3 ? "" : " --verbose");
            write_styled(request, (WalkthroughStyle){.columns = widths[k % 4]});
            check_lines((size_t)widths[k % 4], message);
            write_styled(request, (WalkthroughStyle){.columns = widths[k % 4], .parts = WALKTHROUGH_SUMMARY});
            check_lines((size_t)widths[k % 4], message);
            check_last_line(request, message);
            TEST_ASSERT_LESS_OR_EQUAL_MESSAGE(SUMMARY_LINES, count_lines(), message);
        }
    }
}

/* Mirrors that face each other, and forty lights. */
static void summary_of_a_long_path_should_have_twenty_lines(void)
{
    load("tests/scenes/facing_mirrors.json", ACCEL_NONE);
    scene.shading.max_bounces = 64;
    scene.grid = 2;
    Light *lights = calloc(40, sizeof *lights);
    TEST_ASSERT_NOT_NULL(lights);
    for (int i = 0; i < 40; i++) {
        lights[i] = scene.lights[0];
        lights[i].position.y += 0.3 * (i % 7) - 1;
    }
    free(scene.lights);
    scene.lights = lights;
    scene.light_count = 40;
    int longest = 0;
    for (int p = 0; p < scene.screen.columns * scene.screen.rows; p++) {
        WalkthroughRequest request = {p % scene.screen.columns, p / scene.screen.columns, 0, 0, false};
        write_styled(request, (WalkthroughStyle){.columns = 80, .parts = WALKTHROUGH_SUMMARY});
        check_lines(80, "facing mirrors");
        check_last_line(request, "facing mirrors");
        longest = count_lines() > longest ? count_lines() : longest;
    }
    TEST_ASSERT_LESS_OR_EQUAL(SUMMARY_LINES, longest);
    TEST_ASSERT_GREATER_THAN(16, longest);
}

static void text_of_a_scene_with_six_faces_should_fit_on_three_screens(void)
{
    load("tests/scenes/walkthrough/ambient.json", ACCEL_NONE);
    scene.grid = 1;
    scene.light_count = 1;
    scene.shading.max_bounces = 0;
    write_text((WalkthroughRequest){.column = 8, .row = 6}, INK_PLAIN);
    TEST_ASSERT_LESS_THAN(150, count_lines());
}

static void text_of_a_large_scene_should_be_as_short(void)
{
    load("tests/scenes/walkthrough/ambient.json", ACCEL_NONE);
    enum { MANY = 100000 };
    int few = scene.face_count;
    scene.faces = realloc(scene.faces, MANY * sizeof *scene.faces);
    scene.planes = realloc(scene.planes, MANY * sizeof *scene.planes);
    TEST_ASSERT_TRUE(scene.faces && scene.planes);
    for (int i = few; i < MANY; i++) {
        scene.faces[i] = scene.faces[i % few];
        scene.planes[i] = scene.planes[i % few];
    }
    scene.face_count = MANY;
    scene.grid = 1;
    write_text((WalkthroughRequest){.column = 8, .row = 6}, INK_PLAIN);
    TEST_ASSERT_LESS_THAN(20000, strlen(text));
    TEST_ASSERT_LESS_THAN(200, walk.count);
    check_lines(INK_COLUMNS, "many faces");
}

static int occurrences(const char *word)
{
    int count = 0;
    for (const char *at = text; (at = strstr(at, word)) != NULL; at++)
        count++;
    return count;
}

static void a_face_in_two_leaves_should_be_the_nearest_once(void)
{
    load("scenes/original.json", ACCEL_KDTREE);
    for (int verbose = 0; verbose < 2; verbose++) {
        write_text((WalkthroughRequest){.column = 40, .row = 40, .verbose = verbose}, INK_PLAIN);
        TEST_ASSERT_EQUAL_INT(1, occurrences("+   nearest\n"));
        TEST_ASSERT_EQUAL_INT(1, occurrences("+   met again\n"));
    }
}

static void text_should_show_more_digits_far_from_the_origin(void)
{
    load("tests/scenes/walkthrough/ambient.json", ACCEL_NONE);
    write_text((WalkthroughRequest){.column = 8, .row = 6}, INK_PLAIN);
    TEST_ASSERT_NOT_NULL(strstr(text, "1000003"));
    TEST_ASSERT_NOT_NULL(strstr(text, "its own centre"));
    TEST_ASSERT_NULL(strstr(text, "1e+06"));
}

static void colours_should_be_escape_sequences_and_nothing_else(void)
{
    load("tests/scenes/walkthrough/black.json", ACCEL_NONE);
    WalkthroughRequest request = {.column = 3, .row = 12};
    write_styled(request, (WalkthroughStyle){.parts = WALKTHROUGH_STEPS});
    char *plain = text;
    text = NULL;
    write_styled(request, (WalkthroughStyle){.parts = WALKTHROUGH_STEPS, .colour = INK_TRUE});
    TEST_ASSERT_NULL(strchr(plain, '\033'));
    TEST_ASSERT_NOT_NULL(strchr(text, '\033'));
    char *swatch = strstr(text, "  \033[48;2");
    TEST_ASSERT_NOT_NULL(swatch);
    strcpy(swatch, "\n");
    char *to = text;
    for (char *from = text; *from; from++)
        if (*from == '\033')
            from += strcspn(from, "m");
        else
            *to++ = *from;
    *to = '\0';
    TEST_ASSERT_EQUAL_STRING(plain, text);
    free(plain);
}

/* The same colours as bytes and as the cell beside them. */
static void swatches_should_show_the_bytes_or_the_nearest_of_256_colours(void)
{
    const Ink all = {NULL, INK_TRUE, 80}, few = {NULL, INK_256, 80}, none = {NULL, INK_PLAIN, 80};
    TEST_ASSERT_EQUAL_STRING("\033[48;2;97;74;255m  \033[0m", ink_swatch(&all, (unsigned char[]){97, 74, 255}, 2).text);
    TEST_ASSERT_EQUAL_STRING("\033[48;5;16m \033[0m", ink_swatch(&few, (unsigned char[]){0, 0, 0}, 1).text);
    TEST_ASSERT_EQUAL_STRING("\033[48;5;231m \033[0m", ink_swatch(&few, (unsigned char[]){255, 255, 255}, 1).text);
    TEST_ASSERT_EQUAL_STRING("\033[48;5;239m \033[0m", ink_swatch(&few, (unsigned char[]){79, 79, 79}, 1).text);
    TEST_ASSERT_EQUAL_STRING("\033[48;5;238m \033[0m", ink_swatch(&few, (unsigned char[]){70, 70, 70}, 1).text);
    TEST_ASSERT_EQUAL_STRING("\033[48;5;59m \033[0m", ink_swatch(&few, (unsigned char[]){103, 79, 103}, 1).text);
    TEST_ASSERT_EQUAL_STRING("\033[48;5;255m \033[0m", ink_swatch(&few, (unsigned char[]){240, 240, 240}, 1).text);
    TEST_ASSERT_EQUAL_STRING("\033[48;5;97m \033[0m", ink_swatch(&few, (unsigned char[]){135, 95, 175}, 1).text);
    TEST_ASSERT_EQUAL_STRING("", ink_swatch(&none, (unsigned char[]){1, 2, 3}, 2).text);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(text_should_be_tidy_and_end_with_the_pixel);
    RUN_TEST(text_should_keep_to_the_width_that_is_asked_for);
    RUN_TEST(summary_of_a_long_path_should_have_twenty_lines);
    RUN_TEST(text_of_a_scene_with_six_faces_should_fit_on_three_screens);
    RUN_TEST(text_of_a_large_scene_should_be_as_short);
    RUN_TEST(a_face_in_two_leaves_should_be_the_nearest_once);
    RUN_TEST(text_should_show_more_digits_far_from_the_origin);
    RUN_TEST(colours_should_be_escape_sequences_and_nothing_else);
    RUN_TEST(swatches_should_show_the_bytes_or_the_nearest_of_256_colours);
    return UNITY_END();
}
