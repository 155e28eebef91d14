/* JSON with places: what the grammar takes and refuses, and where errors point. */
#include "base/text.h"
#include "json/json_read.h"
#include "json/json_scan.h"

#include "unity.h"

#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

void setUp(void) {}
void tearDown(void) {}

static bool parses(const char *text)
{
    Json json;
    Error error = {.kind = ERROR_NONE};
    bool good = json_parse(&json, "x.json", text, (long)strlen(text), &error);
    json_free(&json);
    return good;
}

/* The whole message for a text that must not parse. */
static const char *message_of(const char *text, long length)
{
    static Error error;
    Json json;
    error = (Error){.kind = ERROR_NONE};
    TEST_ASSERT_FALSE(json_parse(&json, "x.json", text, length, &error));
    TEST_ASSERT_EQUAL(ERROR_INPUT, error.kind);
    return error.text;
}

static const char *message(const char *text)
{
    return message_of(text, (long)strlen(text));
}

static void assert_begins(const char *expected, const char *text)
{
    TEST_ASSERT_EQUAL_STRING_LEN(expected, text, strlen(expected));
}

static void json_parse_should_accept_every_kind_of_value(void)
{
    static const char *const good[] = {
        "{}",
        "[]",
        "null",
        "true",
        "false",
        "0",
        "-0",
        "10",
        "-1.5",
        "2e3",
        "2E+3",
        "0.5e-3",
        "1e308",
        "1e-400",
        "\"\"",
        "\"a\\\"\\\\\\/\\b\\f\\n\\r\\t\\u00e9\\ud83d\\ude00 é ☃\"",
        " \t\r\n[ 1 ,\r\n 2 ] \n",
        "{\"a\":{\"b\":[[],{}]},\"c\":1}",
    };
    for (size_t i = 0; i < sizeof good / sizeof *good; i++)
        TEST_ASSERT_TRUE_MESSAGE(parses(good[i]), good[i]);
}

static void json_parse_should_refuse_what_the_grammar_does_not_have(void)
{
    static const char *const bad[] = {
        "",
        " ",
        "[",
        "]",
        "{",
        "}",
        "[1",
        "[1,",
        "[1,]",
        "[,1]",
        "[1 2]",
        "{\"a\"}",
        "{\"a\":}",
        "{\"a\":1,}",
        "{a:1}",
        "{1:1}",
        "{\"a\":1 \"b\":2}",
        "[1}",
        "{\"a\":1]",
        "[] []",
        "[]x",
        "nul",
        "nulL",
        "truer",
        "False",
        "'a'",
        "01",
        "-01",
        "00",
        "-",
        "+1",
        ".5",
        "1.",
        "1.e3",
        "1e",
        "1e+",
        "0x10",
        "1e999",
        "-1e999",
        "1_000",
        "1.2.3",
        "--1",
        "NaN",
        "Infinity",
        "-Infinity",
        "\"a",
        "\"a\nb\"",
        "\"\t\"",
        "\"\\x\"",
        "\"\\u12\"",
        "\"\\u12g4\"",
        "\"\\u0000\"",
        "\"\\ud800\"",
        "\"\\ud800\\u0041\"",
        "\"\\udc00\"",
        "\"\xff\"",
        "\"\xc0\x80\"",
        "\"\xed\xa0\x80\"",
        "\"\xf4\x90\x80\x80\"",
        "\"\xe2\x82\"",
        "// a\n1",
        "/* a */ 1",
        "\xEF\xBB\xBF{}",
    };
    for (size_t i = 0; i < sizeof bad / sizeof *bad; i++)
        TEST_ASSERT_FALSE_MESSAGE(parses(bad[i]), bad[i]);
}

static void json_parse_should_refuse_a_nul_byte(void)
{
    assert_begins("x.json:1:2: a NUL byte", message_of("[\0]", 3));
    assert_begins("x.json:1:3: a NUL byte", message_of("[]\0", 3));
    assert_begins("x.json:1:3: a control character", message_of("[\"\0\"]", 5));
}

static void json_parse_should_limit_the_depth(void)
{
    char text[2 * 100001];
    for (int depth = JSON_MAX_DEPTH; depth <= 100000; depth += 100000 - JSON_MAX_DEPTH) {
        memset(text, '[', (size_t)depth);
        memset(text + depth, ']', (size_t)depth);
        text[2 * depth] = '\0';
        TEST_ASSERT_EQUAL(depth == JSON_MAX_DEPTH, parses(text));
    }
}

static void json_parse_should_survive_being_cut_at_every_byte(void)
{
    const char *text = "{ \"a\": [1.5e-3, true, null, \"\\ud83d\\ude00é\"], \"b\": { \"//\": [] } }";
    for (size_t length = 0; length < strlen(text); length++) {
        char *cut = malloc(length + 1); /* of exactly this size: a sanitizer sees a read beyond it */
        memcpy(cut, text, length);
        cut[length] = '\0';
        message_of(cut, (long)length);
        free(cut);
    }
    TEST_ASSERT_TRUE(parses(text));
}

static void json_parse_should_find_repeated_keys(void)
{
    assert_begins("x.json:1:16: b: the key stands twice", message("{\"a\":1, \"b\":2, \"b\":3, \"a\":4}"));
    assert_begins("x.json:1:13: [0].a: the key stands twice", message("[{\"a\":[{}], \"\\u0061\":0}]"));
    TEST_ASSERT_TRUE(parses("[{\"a\":{\"a\":1}}, {\"a\":1, \"A\":2}]"));
}

static void json_errors_should_point_with_line_column_and_caret(void)
{
    TEST_ASSERT_EQUAL_STRING("x.json:2:8: expected ',' or ']', not '3'\n"
                             "  \t[1, 2 3]\n"
                             "  \t      ^",
                             message("[\r\n\t[1, 2 3]\r\n]"));
}

static void json_columns_should_count_characters(void)
{
    const char *text = "[\"é☃\" }";
    TEST_ASSERT_EQUAL_STRING("x.json:1:7: expected ',' or ']', not '}'\n"
                             "  [\"é☃\" }\n"
                             "        ^",
                             message(text));
}

static void json_errors_should_show_a_window_of_a_long_line(void)
{
    char text[4000];
    memset(text, ' ', sizeof text);
    text[0] = '[';
    text[3000] = '?';
    text[sizeof text - 1] = '\0';
    const char *long_one = message_of(text, sizeof text - 1);
    assert_begins("x.json:1:3001: expected a value", long_one);
    TEST_ASSERT_LESS_THAN(400, strlen(long_one));
    TEST_ASSERT_NOT_NULL(strstr(long_one, "\n  ..."));
}

/* Fails at a value of {"list": [10, {"deep key": [true]}], "last": 5} and gives the message. */
static void assert_place(const char *expected, bool at_key, int which)
{
    const char *text = "{\n  \"list\": [10, {\"deep key\": [true]}],\n  \"last\": 5\n}";
    Error error = {.kind = ERROR_NONE};
    Json json;
    TEST_ASSERT_TRUE(json_parse(&json, "x.json", text, (long)strlen(text), &error));
    const cJSON *list = json.root->child, *deep = list->child->next->child;
    const cJSON *const items[] = {json.root, list, list->child, deep, deep->child, list->next};
    if (at_key)
        json_fail_key(&json, items[which], "wrong");
    else
        json_fail(&json, items[which], "wrong");
    assert_begins(expected, error.text);
    json_free(&json);
}

static void json_fail_should_find_the_place_of_every_value(void)
{
    assert_place("x.json:1:1: wrong\n", false, 0);
    assert_place("x.json:2:11: list: wrong\n", false, 1);
    assert_place("x.json:2:12: list[0]: wrong\n", false, 2);
    assert_place("x.json:2:29: list[1][\"deep key\"]: wrong\n", false, 3);
    assert_place("x.json:2:30: list[1][\"deep key\"][0]: wrong\n", false, 4);
    assert_place("x.json:3:11: last: wrong\n", false, 5);
    assert_place("x.json:2:3: list: wrong\n", true, 1);
    assert_place("x.json:2:17: list[1][\"deep key\"]: wrong\n", true, 3);
    assert_place("x.json:2:30: list[1][\"deep key\"][0]: wrong\n", true, 4); /* it has no key */
}

static void json_fail_should_cut_a_name_of_a_million_characters(void)
{
    long length = 1000000;
    char *text = malloc((size_t)length + 9);
    memset(text, 'a', (size_t)length + 9);
    memcpy(text, "{\"", 2);
    memcpy(text + length + 2, "\": 1}", 6);
    Error error = {.kind = ERROR_NONE};
    Json json;
    TEST_ASSERT_TRUE(json_parse(&json, "x.json", text, length + 7, &error));
    JsonMember keys[] = {{.name = "aaa"}};
    TEST_ASSERT_FALSE(json_members(&json, json.root, keys, 1));
    TEST_ASSERT_LESS_THAN(500, strlen(error.text));
    assert_begins("x.json:1:2: [\"aaaa", error.text);
    json_free(&json);
    free(text);
}

static void assert_load_error(const char *reason, const char *path)
{
    Json json;
    Error error = {.kind = ERROR_NONE};
    TEST_ASSERT_FALSE(json_load(&json, path, &error));
    TEST_ASSERT_EQUAL(ERROR_INPUT, error.kind);
    assert_begins(path, error.text);
    TEST_ASSERT_EQUAL_STRING(reason, error.text + strlen(path));
}

static const char *temporary_path(void)
{
    static char path[64];
    snprintf(path, sizeof path, "/tmp/rectray-test-json-%ld", (long)getpid());
    unlink(path);
    return path;
}

static void json_load_should_read_no_device_and_no_folder(void)
{
    assert_load_error(": is a device, not a file", "/dev/null");
    assert_load_error(": is a folder, not a file", "tests");
    assert_load_error(": cannot be opened: No such file or directory", "tests/nowhere.json");
    assert_load_error(": cannot be opened: Not a directory", "tests/test_json.c/x");
}

static void text_read_input_should_read_a_pipe_up_to_its_limit(void)
{
    enum { BYTES = 30000 };
    static char bytes[BYTES];
    memset(bytes, 'x', BYTES);
    for (int limit = BYTES - 1; limit <= BYTES; limit++) {
        int ends[2];
        char path[32], expected[80];
        long length = 0;
        Error error = {.kind = ERROR_NONE};
        TEST_ASSERT_EQUAL(0, pipe(ends));
        TEST_ASSERT_EQUAL(BYTES, write(ends[1], bytes, BYTES));
        close(ends[1]);
        snprintf(path, sizeof path, "/dev/fd/%d", ends[0]);
        snprintf(expected, sizeof expected, "%s: is too large: more than %d bytes", path, BYTES - 1);
        char *text = text_read_input(path, limit, &length, &error);
        close(ends[0]);
        TEST_ASSERT_EQUAL(limit == BYTES, text != NULL);
        if (text)
            TEST_ASSERT_EQUAL(BYTES, length);
        else
            TEST_ASSERT_EQUAL_STRING(expected, error.text);
        free(text);
    }
}

static void json_load_should_refuse_a_file_that_is_not_readable(void)
{
    const char *path = temporary_path();
    FILE *file = fopen(path, "wb");
    TEST_ASSERT_NOT_NULL(file);
    fclose(file);
    TEST_ASSERT_EQUAL(0, chmod(path, 0));
    if (access(path, R_OK) != 0) /* root reads everything */
        assert_load_error(": cannot be opened: Permission denied", path);
    unlink(path);
}

static void json_load_should_refuse_a_file_that_is_too_large(void)
{
    const char *path = temporary_path();
    FILE *file = fopen(path, "wb"); /* sparse: it takes no room on the disk */
    TEST_ASSERT_NOT_NULL(file);
    TEST_ASSERT_EQUAL(0, fseek(file, JSON_MAX_BYTES, SEEK_SET));
    fputc('x', file);
    fclose(file);
    assert_load_error(": is too large: 1073741825 bytes, 1073741824 are allowed", path);
    unlink(path);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(json_parse_should_accept_every_kind_of_value);
    RUN_TEST(json_parse_should_refuse_what_the_grammar_does_not_have);
    RUN_TEST(json_parse_should_refuse_a_nul_byte);
    RUN_TEST(json_parse_should_limit_the_depth);
    RUN_TEST(json_parse_should_survive_being_cut_at_every_byte);
    RUN_TEST(json_parse_should_find_repeated_keys);
    RUN_TEST(json_errors_should_point_with_line_column_and_caret);
    RUN_TEST(json_columns_should_count_characters);
    RUN_TEST(json_errors_should_show_a_window_of_a_long_line);
    RUN_TEST(json_fail_should_find_the_place_of_every_value);
    RUN_TEST(json_fail_should_cut_a_name_of_a_million_characters);
    RUN_TEST(json_load_should_read_no_device_and_no_folder);
    RUN_TEST(text_read_input_should_read_a_pipe_up_to_its_limit);
    RUN_TEST(json_load_should_refuse_a_file_that_is_not_readable);
    RUN_TEST(json_load_should_refuse_a_file_that_is_too_large);
    return UNITY_END();
}
