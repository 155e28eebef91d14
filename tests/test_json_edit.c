/* Values put into a JSON text by their paths: where paths lead, what they add, and ten thousand that lead nowhere. */
#include "json/json_edit.h"
#include "json/json_scan.h"

#include "support/xorshift.h"

#include "unity.h"

#include <stdlib.h>
#include <string.h>

void setUp(void) {}

void tearDown(void) {}

static const char TEXT[] =
    "{ \"camera\": {\"position\": [0, 5, -1]},\n  \"materials\": {\"light grey\": {\"ka\": 1}},\n"
    "  \"lights\": [{\"on\": true}, {}], \"name\": \"a, [b] {c\" }";

static void assert_edit(const char *expected, const char *path, const char *value)
{
    Error error = {.kind = ERROR_NONE};
    char *text = json_edit(TEXT, path, value, &error);
    TEST_ASSERT_NOT_NULL_MESSAGE(text, error.text);
    TEST_ASSERT_NOT_NULL_MESSAGE(strstr(text, expected), text);
    TEST_ASSERT_NULL(json_scan(text, (long)strlen(text)).place);
    free(text);
}

static void assert_refused(const char *expected, const char *path, const char *value)
{
    Error error = {.kind = ERROR_NONE};
    TEST_ASSERT_NULL(json_edit(TEXT, path, value, &error));
    TEST_ASSERT_EQUAL(ERROR_USAGE, error.kind);
    TEST_ASSERT_EQUAL_STRING(expected, error.text);
}

static void json_edit_should_replace_a_value(void)
{
    assert_edit("\"position\": [0, 7.5, -1]}", "camera.position[1]", "7.5");
    assert_edit("{\"position\": [1, 2, 3]},\n", "camera.position", "[1, 2, 3]");
    assert_edit("{\"light grey\": {\"ka\": 2}}", "materials[\"light grey\"].ka", "2");
    assert_edit("[{\"on\": false}, {}]", "lights[0].on", "false");
    assert_edit("\"name\": 3 }", "name", "3");
}

static void json_edit_should_quote_a_word(void)
{
    assert_edit("\"name\": \"ray\" }", "name", "ray");
    assert_edit("\"name\": \"two words\" }", "name", "two words");
    assert_edit("\"name\": \"5\" }", "name", "\"5\"");
    assert_edit("\"name\": \"\" }", "name", "");
}

static void json_edit_should_add_a_key(void)
{
    assert_edit("\"camera\": {\"up\": [0, 0, 1], \"position\"", "camera.up", "[0, 0, 1]");
    assert_edit("[{\"on\": true}, {\"on\": 1}]", "lights[1].on", "1");
    assert_edit("{\"shading\": {\"viewer\": \"ray\"},  \"camera\"", "shading.viewer", "ray");
    assert_edit("{\"a\": {\"b\": {\"c\": 0}},  \"camera\"", "a.b.c", "0");
}

static void json_edit_should_tell_how_far_a_path_leads(void)
{
    assert_refused("lights has no [2]", "lights[2].on", "0");
    assert_refused("camera.position has no x", "camera.position.x", "0");
    assert_refused("the scene has no [0]", "[0]", "0");
    assert_refused("a path is made of keys and indices, such as lights[0].position[1]", "", "0");
    assert_refused("a path is made of keys and indices, such as lights[0].position[1]", "camera..position", "0");
    assert_refused("a path is made of keys and indices, such as lights[0].position[1]", "lights[x]", "0");
    assert_refused("the value is neither JSON nor a plain word", "name", "a\"b");
    assert_refused("the path does not lead to a value that can be set", "a\": 1, \"b", "0");
    assert_refused("the path does not lead to a value that can be set", "camera.a\\b", "0");
}

/* Deeper than any scene, and than a stack. */
static void json_edit_should_refuse_a_path_of_many_steps(void)
{
    enum { STEPS = 100000 };
    static char path[2 * STEPS];
    for (int i = 0; i < STEPS; i++)
        memcpy(path + 2 * i, i < STEPS - 1 ? "a." : "a", 2);
    assert_refused("a path has at most 64 steps", path, "0");
    strcpy(path + 2 * 64, "a");
    assert_refused("a path has at most 64 steps", path, "0");
    strcpy(path + 2 * 63, "a");
    assert_edit("{\"a\": {\"a\": {", path, "0");
}

/* Whatever the path and the value: there is an error, or a JSON text. */
static void json_edit_should_survive_ten_thousand_paths(void)
{
    static const char *const pieces[] = {"camera", "position", "lights", "name", "[0]", "[1]", "[99999999999999999999]",
                                         ".",      "[",        "]",      "\"",   "[\"", "\"]", "light grey",
                                         "\\",     "\n",       "{",      ",",    "on",  "=",   "[-1]"};
    enum { PIECES = sizeof pieces / sizeof *pieces };
    uint64_t state = 1;
    int edited = 0;
    for (int i = 0; i < 10000; i++) {
        char path[160] = "", value[80] = "";
        for (uint64_t left = random_next(&state) % 6; left > 0; left--)
            strcat(path, pieces[random_next(&state) % PIECES]);
        for (uint64_t left = random_next(&state) % 3; left > 0; left--)
            strcat(value, pieces[random_next(&state) % PIECES]);
        Error error = {.kind = ERROR_NONE};
        char *text = json_edit(TEXT, path, value, &error);
        TEST_ASSERT_EQUAL_MESSAGE(text == NULL, error.kind != ERROR_NONE, path);
        TEST_ASSERT_TRUE_MESSAGE(!text || !json_scan(text, (long)strlen(text)).place, text);
        edited += text != NULL;
        free(text);
    }
    TEST_ASSERT_GREATER_THAN(100, edited);
}

static void json_edit_should_find_keys_with_escapes(void)
{
    Error error = {.kind = ERROR_NONE};
    char *text = json_edit("{\"c\\u0061mera\": {\"\\u00e9 \\\"\": 1, \"é\": 2}}", "camera.é", "3", &error);
    TEST_ASSERT_EQUAL_STRING("{\"c\\u0061mera\": {\"\\u00e9 \\\"\": 1, \"é\": 3}}", text);
    free(text);
    TEST_ASSERT_TRUE(json_has("{\"c\\u0061mera\": 1}", "camera"));
    TEST_ASSERT_FALSE(json_has("{\"a\": {\"camera\": 1}}", "camera"));
    TEST_ASSERT_FALSE(json_has("{\"camera", "camera"));
}

static void assert_without(const char *expected, const char *text)
{
    char *rest = json_without(text, "b");
    TEST_ASSERT_EQUAL_STRING(expected, rest);
    free(rest);
}

static void json_without_should_leave_no_comma(void)
{
    assert_without("{ \"a\": 1, \"c\": 3 }", "{ \"a\": 1, \"b\": [2, {}], \"c\": 3 }");
    assert_without("{ \"a\": 1 }", "{ \"a\": 1,\n \"b\": 2 }");
    assert_without("{ \"c\": 3 }", "{ \"b\" : \"},\" , \"c\": 3 }");
    assert_without("{ }", "{ \"\\u0062\": 2 }");
    assert_without("{ \"a\": { \"b\": 2 } }", "{ \"a\": { \"b\": 2 } }");
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(json_edit_should_replace_a_value);
    RUN_TEST(json_edit_should_quote_a_word);
    RUN_TEST(json_edit_should_add_a_key);
    RUN_TEST(json_edit_should_tell_how_far_a_path_leads);
    RUN_TEST(json_edit_should_find_keys_with_escapes);
    RUN_TEST(json_without_should_leave_no_comma);
    RUN_TEST(json_edit_should_refuse_a_path_of_many_steps);
    RUN_TEST(json_edit_should_survive_ten_thousand_paths);
    return UNITY_END();
}
