/* Texts that no student writes by intent: cut off anywhere, nested without end, with names of a million characters,
 * with numbers at the limits. Each is a scene, or one message that is short. Single mistakes are in
 * tests/scenes/bad/. */
#include "base/text.h"
#include "reader/scene_json.h"

#include "unity.h"

#include <glob.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static Error error;
static Scene scene;

void setUp(void)
{
    error = (Error){0};
    scene = (Scene){0};
}

void tearDown(void)
{
    scene_free(&scene);
}

/* Parses a text as if it were a file in tests/scenes/. A message is at most a few lines of a terminal. */
static bool parse(const char *text, long length)
{
    scene_free(&scene);
    error = (Error){0};
    bool good = scene_parse(&scene, "tests/scenes/x.json", text, length, &error);
    TEST_ASSERT_EQUAL_INT_MESSAGE(good ? ERROR_NONE : ERROR_INPUT, error.kind, error.text);
    if (!good) {
        TEST_ASSERT_LESS_THAN(1000, strlen(error.text));
        TEST_ASSERT_EQUAL_INT_MESSAGE(0, strncmp(error.text, "tests/scenes/", 13), error.text);
    }
    return good;
}

/* --- Cut off --- */

/* `text` up to every length: all but the whole is refused, but for what comes after the end. */
static void cut_everywhere(const char *path, const char *text, long length)
{
    long end = length;
    while (end > 0 && strchr(" \t\r\n", text[end - 1]))
        end--;
    for (long cut = 0; cut <= length; cut++) {
        char *part = malloc((size_t)cut + 1); /* of its own size: AddressSanitizer sees a read past the end */
        TEST_ASSERT_NOT_NULL(part);
        memcpy(part, text, (size_t)cut);
        part[cut] = '\0';
        TEST_ASSERT_EQUAL_INT_MESSAGE(cut >= end, parse(part, cut), path);
        free(part);
    }
}

static void scene_cut_at_every_byte_should_be_refused(void)
{
    glob_t found;
    TEST_ASSERT_EQUAL_INT(0, glob("tests/scenes/*.json", 0, NULL, &found));
    for (size_t i = 0; i < found.gl_pathc; i++) {
        long length = 0;
        char *text = text_read(found.gl_pathv[i], 1 << 20, &length, &error);
        TEST_ASSERT_NOT_NULL_MESSAGE(text, error.text);
        if (length < 3000)
            cut_everywhere(found.gl_pathv[i], text, length);
        free(text);
    }
    globfree(&found);
}

/* --- Without end --- */

/* `opening` so many times, and a text after it. */
static char *repeated(const char *before, const char *opening, int times, const char *after)
{
    size_t length = strlen(opening), first = strlen(before), size = first + length * (size_t)times + strlen(after) + 1;
    char *text = malloc(size);
    if (!text)
        abort();
    memcpy(text, before, first);
    for (int i = 0; i < times; i++)
        memcpy(text + first + (size_t)i * length, opening, length);
    strcpy(text + first + (size_t)times * length, after);
    return text;
}

static void assert_refused(char *text, const char *message)
{
    TEST_ASSERT_FALSE(parse(text, (long)strlen(text)));
    error.text[strcspn(error.text, "\n")] = '\0';
    TEST_ASSERT_EQUAL_STRING(message, error.text);
    free(text);
}

static void deep_nesting_should_be_refused_without_recursion(void)
{
    enum { DEEP = 100000 };
    const char *too_deep = "tests/scenes/x.json:1:65: lists and objects are nested more than 64 deep";
    assert_refused(repeated("", "[", DEEP, ""), too_deep);
    assert_refused(repeated("", "[", DEEP, "]"), too_deep);
    assert_refused(repeated("", "{\"\":", DEEP, ""),
                   "tests/scenes/x.json:1:257: lists and objects are nested more than 64 deep");
    assert_refused(repeated("{\"objects\":", "[", DEEP, ""),
                   "tests/scenes/x.json:1:75: lists and objects are nested more than 64 deep");
}

#define HEAD "{\"camera\":{\"position\":[0,0,5],\"look_at\":[0,0,0]},\"screen\":{\"columns\":4,\"rows\":3}"

enum { LONG_NAME = 1000000 };

static void long_names_should_load_or_be_cut_in_the_message(void)
{
    char *text = repeated(HEAD ",\"materials\":{\"m\":{}},\"objects\":[{\"name\":\"", "x", LONG_NAME,
                          "\",\"material\":\"m\",\"box\":{\"min\":[0,0,0],\"max\":[1,1,1]}}]}");
    TEST_ASSERT_TRUE_MESSAGE(parse(text, (long)strlen(text)), error.text);
    TEST_ASSERT_EQUAL_INT(LONG_NAME, strlen(scene.objects[0].name));
    free(text);

    text = repeated(HEAD ",\"materials\":{\"", "x", LONG_NAME, "\":{}}}");
    TEST_ASSERT_TRUE_MESSAGE(parse(text, (long)strlen(text)), error.text);
    TEST_ASSERT_EQUAL_INT(LONG_NAME, strlen(scene.materials[0].name));
    free(text);

    text = repeated(HEAD ",\"objects\":[{\"material\":\"", "x", LONG_NAME,
                    "\",\"box\":{\"min\":[0,0,0],\"max\":[1,1,1]}}]}");
    TEST_ASSERT_FALSE(parse(text, (long)strlen(text)));
    TEST_ASSERT_NOT_NULL(strstr(error.text, "xxx...\" does not exist"));
    free(text);

    text = repeated(HEAD ",\"", "x", LONG_NAME, "\":1}");
    TEST_ASSERT_FALSE(parse(text, (long)strlen(text)));
    TEST_ASSERT_NOT_NULL(strstr(error.text, "xxx...\"]: unknown key"));
    free(text);

    text =
        repeated(HEAD ",\"materials\":{\"m\":{}},\"objects\":[{\"material\":\"m\",\"obj\":\"", "x", LONG_NAME, "\"}]}");
    TEST_ASSERT_FALSE(parse(text, (long)strlen(text)));
    TEST_ASSERT_NOT_NULL(strstr(error.text, "objects[0].obj: "));
    TEST_ASSERT_NOT_NULL(strstr(error.text, "xxx...\": cannot be opened: File name too long"));
    free(text);

    /* The longest path that the system may look for, of names that are not there. */
    text = repeated(HEAD ",\"objects\":[{\"obj\":\"", "nowhere/", 500, "\"}]}");
    error = (Error){0};
    TEST_ASSERT_FALSE(scene_parse(&scene, "x.json", text, (long)strlen(text), &error));
    TEST_ASSERT_NOT_NULL(strstr(error.text, "nowhere/: cannot be opened: No such file or directory\n"));
    free(text);
}

static void long_strings_should_be_shown_by_their_beginning(void)
{
    char *text = repeated(HEAD ",\"objects\":\"", "x", LONG_NAME, "");
    TEST_ASSERT_FALSE(parse(text, (long)strlen(text)));
    free(text);
    text = repeated(HEAD ",\"//\":\"", "x", LONG_NAME, "\"}");
    TEST_ASSERT_TRUE_MESSAGE(parse(text, (long)strlen(text)), error.text);
    free(text);
    text = repeated("", " ", LONG_NAME, "");
    TEST_ASSERT_FALSE(parse(text, (long)strlen(text)));
    free(text);
}

/* --- Numbers --- */

/* The camera's x as it is written; a scene without faces is centred on its camera. */
static bool parse_number(const char *number)
{
    char text[512];
    snprintf(text, sizeof text,
             "{\"camera\":{\"position\":[%s,0,5],\"look_at\":[0,0,0]},\"screen\":{\"columns\":4,\"rows\":3}}", number);
    return parse(text, (long)strlen(text));
}

static void numbers_should_be_read_as_the_grammar_says(void)
{
    static const char *const good[] = {"0",      "-0",   "-0.0",  "1e-320", "-4.9e-324",
                                       "1e-999", "1E+2", "0e999", "1.0e-0", "100000000000000000000e-18"};
    static const char *const bad[] = {"1e999", "-1e999", "0x10",  "007", "-007",     "00",        "01.5",
                                      "1.",    ".5",     "+1",    "1e",  "1e+",      "--1",       "1_000",
                                      "1,0,",  "NaN",    "nan",   "inf", "Infinity", "-Infinity", "1f",
                                      "0b1",   "1.2.3",  "1e5.5", "-",   "\xD9\xA1"};
    for (size_t i = 0; i < sizeof good / sizeof *good; i++) {
        TEST_ASSERT_TRUE_MESSAGE(parse_number(good[i]), error.text);
        TEST_ASSERT_TRUE(scene.centre.x + scene.camera.position.x == strtod(good[i], NULL));
    }
    for (size_t i = 0; i < sizeof bad / sizeof *bad; i++)
        TEST_ASSERT_FALSE_MESSAGE(parse_number(bad[i]), bad[i]);
}

/* --- Bytes --- */

static void line_ends_of_any_system_should_count_as_one(void)
{
    const char text[] = "{\r\n\"camera\":{\"position\":[0,0,5],\r\n\"look_at\":[0,0,0]},\r\n\"screen\":7}";
    TEST_ASSERT_FALSE(parse(text, sizeof text - 1));
    TEST_ASSERT_NOT_NULL_MESSAGE(strstr(error.text, "x.json:4:10: screen: must be an object, not a number\n"),
                                 error.text);
}

/* Every byte at every place of a small scene; most are refused, none may break anything. */
static void any_byte_anywhere_should_be_survived(void)
{
    char text[] =
        HEAD ",\"lights\":[{\"position\":[1,2,3]}],\"materials\":{\"m\\u00e9\":{\"diffuse\":[1,1,0.5]}},"
             "\"objects\":[{\"material\":\"m\xC3\xA9\",\"vertices\":[[0,0,0],[1,0,0],[1,1,0]],\"faces\":[[0,1,2]]}]}";
    TEST_ASSERT_TRUE_MESSAGE(parse(text, sizeof text - 1), error.text);
    for (size_t i = 0; i + 1 < sizeof text; i++) {
        char before = text[i];
        for (int c = 0; c < 256; c++) {
            text[i] = (char)c;
            parse(text, sizeof text - 1);
        }
        text[i] = before;
    }
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(scene_cut_at_every_byte_should_be_refused);
    RUN_TEST(deep_nesting_should_be_refused_without_recursion);
    RUN_TEST(long_names_should_load_or_be_cut_in_the_message);
    RUN_TEST(long_strings_should_be_shown_by_their_beginning);
    RUN_TEST(numbers_should_be_read_as_the_grammar_says);
    RUN_TEST(line_ends_of_any_system_should_count_as_one);
    RUN_TEST(any_byte_anywhere_should_be_survived);
    return UNITY_END();
}
