/* What the web page asks of the tracer (src/page), here without a browser: the calls of page_module.c as JavaScript
 * makes them. That their answers are the program's own is the subject of page_test.py. */
#include "page/page.h"
#include "walkthrough/walkthrough_lines.h"

#include "support/assert_vec3.h"
#include "unity.h"

#include <cjson/cJSON.h>

#include <stdlib.h>
#include <string.h>

#define SCENE "scenes/original.json"

void *page_alloc(int bytes);
void page_free(void *block);
const char *page_error(void);
int page_open(const char *path);
void page_set(int columns, int rows, int grid, int adaptive, int arithmetic, int tree);
int page_bytes(int column, int row, int arithmetic);
double page_value(int which);
const unsigned char *page_rows(int first, int count, int step);
const unsigned char *page_map(int kind);
const char *page_trace(int column, int row, int sample, int format, int flags, int columns);
const char *page_diff(int column, int row, int other_column, int other_row, int columns);
const float *page_numbers(void);
int page_faces(void);
int page_places(void);
int page_seen(void);
int page_lines(int column, int row, int sample);
int page_tested(int column, int row, int sample, int hit, int light);
int page_nodes(int column, int row, int hit, int light);
const char *page_text(void);
const char *page_node_verdict(int verdict);
const char *page_face_name(int face);
const char *page_verdict(int verdict);

enum { COLUMNS, ROWS, GRID, ADAPTIVE, FACES, LIGHTS, LOW, HIGH, LENGTH };

void setUp(void)
{
    TEST_ASSERT_TRUE_MESSAGE(page_open(SCENE), page_error());
    page_set(80, 60, 1, 0, 0, ACCEL_NONE);
}

void tearDown(void) {}

static void page_open_should_keep_the_scene_before_a_wrong_one(void)
{
    TEST_ASSERT_FALSE(page_open("tests/scenes/bad/empty.json"));
    TEST_ASSERT_EQUAL_STRING_LEN("tests/scenes/bad/empty.json:1:1: ", page_error(), 33);
    TEST_ASSERT_EQUAL_DOUBLE(80, page_value(COLUMNS));
    TEST_ASSERT_NOT_NULL(page_trace(0, 0, 0, 0, 0, 0));
}

static void page_values_should_describe_the_scene(void)
{
    TEST_ASSERT_EQUAL_DOUBLE(60, page_value(ROWS));
    TEST_ASSERT_EQUAL_DOUBLE(1, page_value(GRID));
    TEST_ASSERT_EQUAL_DOUBLE(0, page_value(ADAPTIVE));
    TEST_ASSERT_GREATER_THAN_INT(0, (int)page_value(FACES));
    TEST_ASSERT_GREATER_THAN_INT(0, (int)page_value(LIGHTS));
    TEST_ASSERT_EQUAL_DOUBLE(0, page_value(99));
    page_set(0, 0, 3, 1, 0, ACCEL_NONE);
    TEST_ASSERT_EQUAL_DOUBLE(80, page_value(COLUMNS));
    TEST_ASSERT_EQUAL_DOUBLE(3, page_value(GRID));
    TEST_ASSERT_EQUAL_DOUBLE(1, page_value(ADAPTIVE));
}

static void page_rows_should_be_those_of_the_whole_picture(void)
{
    unsigned char *whole = malloc(80 * 60 * 4);
    memcpy(whole, page_rows(0, 60, 1), 80 * 60 * 4);
    for (int row = 0; row < 60; row += 12)
        TEST_ASSERT_EQUAL_MEMORY(whole + row * 80 * 4, page_rows(row, 12, 1), 12 * 80 * 4);
    free(whole);
}

static void coarse_rows_should_be_blocks_of_their_middles_colour(void)
{
    unsigned char *coarse = malloc(80 * 60 * 4);
    memcpy(coarse, page_rows(0, 60, 8), 80 * 60 * 4);
    for (int row = 0; row < 56; row++)
        for (int column = 0; column < 80; column++) {
            const unsigned char *at = coarse + 4 * (row * 80 + column);
            int middle = page_bytes(column / 8 * 8 + 4, row / 8 * 8 + 4, 0);
            TEST_ASSERT_EQUAL_HEX32(middle, at[0] << 16 | at[1] << 8 | at[2]);
        }
    free(coarse);
}

static void rows_should_be_of_the_arithmetic_that_was_set(void)
{
    for (int arithmetic = 0; arithmetic <= 2; arithmetic++) {
        page_set(0, 0, 0, 0, arithmetic, ACCEL_NONE);
        const unsigned char *at = page_rows(36, 1, 1) + 40 * 4;
        TEST_ASSERT_EQUAL_HEX32(page_bytes(40, 36, arithmetic), at[0] << 16 | at[1] << 8 | at[2]);
    }
    TEST_ASSERT_EQUAL_HEX32(97 << 16 | 74 << 8 | 97, page_bytes(40, 36, 0));
}

static void map_of_rays_should_have_a_scale(void)
{
    TEST_ASSERT_NOT_NULL(page_map(MAP_RAYS));
    TEST_ASSERT_EQUAL_DOUBLE(1, page_value(LOW));
    TEST_ASSERT_GREATER_THAN_INT(1, (int)page_value(HIGH));
    TEST_ASSERT_NOT_NULL(page_map(MAP_TESTS));
    TEST_ASSERT_TRUE(page_value(HIGH) > 1);
}

static void steps_should_hold_all_of_the_text(void)
{
    char *text = strdup(page_trace(40, 36, 0, 0, 0, 0));
    const char *steps = page_trace(40, 36, 0, 4, 0, 0);
    TEST_ASSERT_EQUAL_INT((int)strlen(steps), (int)page_value(LENGTH));
    cJSON *json = cJSON_Parse(steps), *step;
    /* The summary is not among the steps. */
    const char *head = strstr(cJSON_GetObjectItem(json, "head")->valuestring, "Step by step");
    size_t length = (size_t)(strstr(text, "Step by step") - text) + strlen(head);
    TEST_ASSERT_EQUAL_STRING_LEN(strstr(text, "Step by step"), head, strlen(head));
    int number = 0;
    cJSON_ArrayForEach(step, cJSON_GetObjectItem(json, "steps"))
    {
        const char *part = cJSON_GetObjectItem(step, "text")->valuestring;
        TEST_ASSERT_EQUAL_STRING_LEN(text + length, part, strlen(part));
        TEST_ASSERT_EQUAL_INT(++number, cJSON_GetObjectItem(step, "number")->valueint);
        bool first = number <= 2; /* the primary ray and its nearest face: they look for P1 */
        TEST_ASSERT_TRUE(!first || cJSON_GetObjectItem(step, "hit")->valueint == 1);
        length += strlen(part);
    }
    TEST_ASSERT_EQUAL_INT((int)strlen(text), (int)length);
    TEST_ASSERT_NOT_NULL(strstr(text, cJSON_GetObjectItem(json, "pixel")->valuestring));
    TEST_ASSERT_NOT_NULL(strstr(text, cJSON_GetObjectItem(json, "end")->valuestring));
    cJSON_Delete(json);
    free(text);
}

static void every_format_should_be_written(void)
{
    for (int format = 0; format < PAGE_FORMAT_COUNT; format++)
        TEST_ASSERT_NOT_NULL(page_trace(40, 36, 0, format, 3, 0));
}

static void answer_should_name_what_blocks_a_light(void)
{
    TEST_ASSERT_TRUE(page_open("scenes/gallery.json"));
    page_set(640, 360, 1, 0, 0, ACCEL_NONE);
    cJSON *json = cJSON_Parse(page_trace(450, 190, 0, 4, 0, 0));
    const cJSON *hits = cJSON_GetObjectItem(json, "hits"), *third = cJSON_GetArrayItem(hits, 2);
    TEST_ASSERT_EQUAL_INT(4, cJSON_GetArraySize(hits));
    TEST_ASSERT_EQUAL_STRING("mirror/0", cJSON_GetObjectItem(cJSON_GetArrayItem(hits, 0), "face")->valuestring);
    TEST_ASSERT_EQUAL_STRING("star/21", cJSON_GetObjectItem(third, "face")->valuestring);
    const cJSON *light = cJSON_GetArrayItem(cJSON_GetObjectItem(third, "lights"), 0);
    TEST_ASSERT_EQUAL_STRING("blocked", cJSON_GetObjectItem(light, "verdict")->valuestring);
    TEST_ASSERT_EQUAL_STRING("glazing bar 3/2", cJSON_GetObjectItem(light, "blocker")->valuestring);
    cJSON_Delete(json);
}

static void lists_should_have_their_numbers(void)
{
    TEST_ASSERT_EQUAL_INT((int)page_value(FACES) * PAGE_FACE_NUMBERS, page_faces());
    TEST_ASSERT_TRUE(page_numbers()[0] == 3 || page_numbers()[0] == 4);
    TEST_ASSERT_EQUAL_INT(3 * (7 + (int)page_value(LIGHTS)), page_places());
    TEST_ASSERT_GREATER_THAN_INT(0, page_seen());
    int lines = page_lines(40, 36, 0);
    TEST_ASSERT_GREATER_THAN_INT(0, lines);
    TEST_ASSERT_EQUAL_INT(0, lines % PAGE_LINE_NUMBERS);
    TEST_ASSERT_EQUAL_FLOAT((float)LINE_PRIMARY, page_numbers()[0]);
}

static void places_should_have_the_screen_around_the_view(void)
{
    page_places();
    const float *at = page_numbers();
    Vec3 corners[4];
    for (int k = 0; k < 4; k++)
        corners[k] = vec3((double)at[9 + 3 * k], (double)at[10 + 3 * k], (double)at[11 + 3 * k]);
    Vec3 across = vec3_sub(corners[1], corners[0]), back = vec3_sub(corners[2], corners[3]);
    ASSERT_VEC3_WITHIN(1e-4, across.x, across.y, across.z, back);
}

static int count_tested(int hit, int light, FaceVerdict verdict)
{
    int count = 0, numbers = page_tested(40, 36, 0, hit, light);
    for (int k = 0; k < numbers; k += 2)
        count += page_numbers()[k + 1] == (float)verdict;
    return count;
}

static void tested_faces_should_be_those_of_the_search(void)
{
    int faces = (int)page_value(FACES);
    TEST_ASSERT_EQUAL_INT(2 * faces, page_tested(40, 36, 0, 1, -1));
    TEST_ASSERT_GREATER_THAN_INT(0, count_tested(1, -1, FACE_INSIDE));
    TEST_ASSERT_EQUAL_INT(0, count_tested(1, -1, FACE_LEFT));
    TEST_ASSERT_EQUAL_INT(1, count_tested(2, -1, FACE_LEFT));
    TEST_ASSERT_GREATER_THAN_INT(0, page_tested(40, 36, 0, 1, 0));
    TEST_ASSERT_EQUAL_INT(0, page_tested(40, 36, 0, 50, -1));
}

static int count_lines(const char *text)
{
    int count = 0;
    for (; *text; text++)
        count += *text == '\n';
    return count;
}

static void nodes_should_be_those_of_the_search(void)
{
    for (int kind = ACCEL_KDTREE; kind <= ACCEL_BVH; kind++) {
        page_set(0, 0, 0, 0, 0, kind);
        TEST_ASSERT_NOT_NULL(strstr(page_trace(40, 36, 0, PAGE_TEXT, 0, 0), "tree nodes whose boxes are tested"));
        char *verbose = strdup(page_trace(40, 36, 0, PAGE_TEXT, 1, 160));
        int count = page_nodes(40, 36, 1, -1);
        TEST_ASSERT_GREATER_THAN_INT(0, count);
        TEST_ASSERT_EQUAL_INT(0, count % PAGE_NODE_NUMBERS);
        TEST_ASSERT_EQUAL_STRING("entered", page_node_verdict((int)page_numbers()[0]));
        /* A line of each, as the text has it. */
        const char *words = page_text();
        TEST_ASSERT_EQUAL_INT(count / PAGE_NODE_NUMBERS, count_lines(words));
        size_t length = strcspn(words, ";");
        char *first = strndup(words, length);
        TEST_ASSERT_NOT_NULL(strstr(verbose, first));
        free(first);
        free(verbose);
        TEST_ASSERT_GREATER_THAN_INT(0, page_nodes(40, 36, 1, 0));
        TEST_ASSERT_EQUAL_INT(0, page_nodes(40, 36, 50, -1));
    }
    TEST_ASSERT_EQUAL_STRING("", page_node_verdict(99));
}

static void textbook_steps_should_name_where_the_two_part(void)
{
    TEST_ASSERT_TRUE_MESSAGE(page_open("scenes/lessons/acne.json"), page_error());
    page_set(80, 60, 1, 0, PAGE_TEXTBOOK_FLOAT, ACCEL_NONE);
    char *text = strdup(page_trace(30, 46, 0, PAGE_TEXTBOOK_TEXT, 0, 0));
    cJSON *json = cJSON_Parse(page_trace(30, 46, 0, PAGE_TEXTBOOK_STEPS, 0, 0));
    const char *head = cJSON_GetObjectItem(json, "head")->valuestring;
    TEST_ASSERT_EQUAL_STRING_LEN(head, text, strlen(head));
    const cJSON *part = cJSON_GetArrayItem(cJSON_GetObjectItem(json, "parts"), 0);
    TEST_ASSERT_NOT_NULL(strstr(head, "They part at P1, in what they say of light 0."));
    TEST_ASSERT_EQUAL_INT(1, cJSON_GetObjectItem(part, "hit")->valueint);
    TEST_ASSERT_EQUAL_INT(0, cJSON_GetObjectItem(part, "light")->valueint);
    const char *summary = cJSON_GetObjectItem(json, "summary")->valuestring;
    TEST_ASSERT_EQUAL_STRING_LEN(summary, text, strlen(summary));
    const cJSON *light = cJSON_GetArrayItem(cJSON_GetObjectItem(json, "steps"), 2);
    TEST_ASSERT_EQUAL_STRING("light", cJSON_GetObjectItem(light, "kind")->valuestring);
    TEST_ASSERT_EQUAL_INT(3, cJSON_GetObjectItem(light, "number")->valueint);
    TEST_ASSERT_NOT_NULL(strstr(cJSON_GetObjectItem(light, "text")->valuestring, "Here the two part."));
    cJSON_Delete(json);
    free(text);
}

static void diff_should_say_where_two_pixels_part(void)
{
    const char *text = page_diff(40, 36, 0, 0, 0);
    TEST_ASSERT_EQUAL_STRING_LEN("Pixels (40, 36) and (0, 0) of scenes/original.json\n", text, 51);
    TEST_ASSERT_NOT_NULL(strstr(text, "They part at P1: the first one hits"));
    TEST_ASSERT_NOT_NULL(strstr(page_diff(40, 36, 40, 36, 0), "They take the same path"));
}

static void names_should_be_the_walkthroughs(void)
{
    TEST_ASSERT_NOT_NULL(strstr(page_trace(40, 36, 0, 0, 1, 0), page_face_name(0)));
    TEST_ASSERT_EQUAL_STRING("outside", page_verdict(FACE_OUTSIDE));
    TEST_ASSERT_EQUAL_STRING("", page_verdict(-1));
}

static void memory_should_be_lent(void)
{
    char *block = page_alloc(16);
    TEST_ASSERT_NOT_NULL(block);
    page_free(block);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(page_open_should_keep_the_scene_before_a_wrong_one);
    RUN_TEST(page_values_should_describe_the_scene);
    RUN_TEST(page_rows_should_be_those_of_the_whole_picture);
    RUN_TEST(coarse_rows_should_be_blocks_of_their_middles_colour);
    RUN_TEST(rows_should_be_of_the_arithmetic_that_was_set);
    RUN_TEST(map_of_rays_should_have_a_scale);
    RUN_TEST(steps_should_hold_all_of_the_text);
    RUN_TEST(every_format_should_be_written);
    RUN_TEST(answer_should_name_what_blocks_a_light);
    RUN_TEST(lists_should_have_their_numbers);
    RUN_TEST(places_should_have_the_screen_around_the_view);
    RUN_TEST(tested_faces_should_be_those_of_the_search);
    RUN_TEST(nodes_should_be_those_of_the_search);
    RUN_TEST(textbook_steps_should_name_where_the_two_part);
    RUN_TEST(diff_should_say_where_two_pixels_part);
    RUN_TEST(names_should_be_the_walkthroughs);
    RUN_TEST(memory_should_be_lent);
    return UNITY_END();
}
