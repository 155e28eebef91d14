/* The walkthrough as text, for every pixel of the scenes that take every branch: no line is too long, no number is
 * ugly, and the last line states the pixel. */
#include "reader/scene_json.h"
#include "unity.h"
#include "walkthrough/walkthrough_formats.h"

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

static void write_text(WalkthroughRequest request, bool colour)
{
    size_t size = 0;
    free(text);
    text = NULL;
    walkthrough_free(&walk);
    TEST_ASSERT_TRUE_MESSAGE(walkthrough_record(&walk, &scene, &accel, "scene.json", request, &error), error.text);
    FILE *out = open_memstream(&text, &size);
    TEST_ASSERT_NOT_NULL(out);
    TEST_ASSERT_TRUE(walkthrough_write_text(out, &walk, (WalkthroughStyle){.colour = colour}, &error));
    TEST_ASSERT_EQUAL_INT(0, fclose(out));
}

static void check_lines(const char *message)
{
    for (const char *line = text; *line;) {
        size_t length = strcspn(line, "\n");
        TEST_ASSERT_LESS_OR_EQUAL_MESSAGE(100, length, message); /* the names are ASCII */
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
            write_text(request, false);
            check_lines(message);
            check_last_line(request, message);
        }
    }
}

static void text_of_a_scene_with_six_faces_should_fit_on_two_screens(void)
{
    load("tests/scenes/walkthrough/ambient.json", ACCEL_NONE);
    scene.grid = 1;
    scene.light_count = 1;
    scene.shading.max_bounces = 0;
    write_text((WalkthroughRequest){.column = 8, .row = 6}, false);
    int lines = 0;
    for (const char *c = text; *c; c++)
        lines += *c == '\n';
    TEST_ASSERT_LESS_THAN(110, lines);
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
    write_text((WalkthroughRequest){.column = 8, .row = 6}, false);
    TEST_ASSERT_LESS_THAN(20000, strlen(text));
    TEST_ASSERT_LESS_THAN(200, walk.count);
    check_lines("many faces");
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
        write_text((WalkthroughRequest){.column = 40, .row = 40, .verbose = verbose}, false);
        TEST_ASSERT_EQUAL_INT(1, occurrences("+   nearest\n"));
        TEST_ASSERT_EQUAL_INT(1, occurrences("+   met again\n"));
    }
}

static void text_should_show_more_digits_far_from_the_origin(void)
{
    load("tests/scenes/walkthrough/ambient.json", ACCEL_NONE);
    write_text((WalkthroughRequest){.column = 8, .row = 6}, false);
    TEST_ASSERT_NOT_NULL(strstr(text, "1000003"));
    TEST_ASSERT_NOT_NULL(strstr(text, "as seen from its own centre"));
    TEST_ASSERT_NULL(strstr(text, "1e+06"));
}

static void colours_should_be_escape_sequences_and_nothing_else(void)
{
    load("tests/scenes/walkthrough/black.json", ACCEL_NONE);
    WalkthroughRequest request = {.column = 3, .row = 12};
    write_text(request, false);
    char *plain = text;
    text = NULL;
    write_text(request, true);
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

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(text_should_be_tidy_and_end_with_the_pixel);
    RUN_TEST(text_of_a_scene_with_six_faces_should_fit_on_two_screens);
    RUN_TEST(text_of_a_large_scene_should_be_as_short);
    RUN_TEST(a_face_in_two_leaves_should_be_the_nearest_once);
    RUN_TEST(text_should_show_more_digits_far_from_the_origin);
    RUN_TEST(colours_should_be_escape_sequences_and_nothing_else);
    return UNITY_END();
}
