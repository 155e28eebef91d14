/* The fuzzers' targets over all inputs that are kept: the seeds, and what once broke something (tests/fuzz/NAME/). */
#include "fuzz/fuzz.h"

#include "support/xorshift.h"

#include "unity.h"

#include <glob.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

void setUp(void) {}
void tearDown(void) {}

/* A heap block of the exact size, so that AddressSanitizer sees a read past the end. */
static void run_file(const char *path, int (*target)(const uint8_t *, size_t))
{
    FILE *file = fopen(path, "rb");
    TEST_ASSERT_NOT_NULL_MESSAGE(file, path);
    TEST_ASSERT_EQUAL_INT(0, fseek(file, 0, SEEK_END));
    size_t size = (size_t)ftell(file);
    rewind(file);
    uint8_t *data = malloc(size ? size : 1);
    TEST_ASSERT_NOT_NULL(data);
    TEST_ASSERT_EQUAL_INT(size, fread(data, 1, size, file));
    fclose(file);
    printf("%s\n", path); /* the last one named is the one that broke it */
    fflush(stdout);
    target(data, size);
    free(data);
}

static void run_all(const char *pattern, int (*target)(const uint8_t *, size_t))
{
    glob_t found;
    TEST_ASSERT_EQUAL_INT_MESSAGE(0, glob(pattern, 0, NULL, &found), pattern);
    for (size_t i = 0; i < found.gl_pathc; i++)
        run_file(found.gl_pathv[i], target);
    globfree(&found);
}

#define TEST_OF(name)                                                     \
    static void name##_should_keep_its_promises_on_every_kept_input(void) \
    {                                                                     \
        run_all("tests/fuzz/" #name "/*", fuzz_##name);                   \
    }
FUZZ_TARGETS(TEST_OF)

/* Other tests' files are inputs, too. */
static void scene_should_keep_its_promises_on_every_test_scene(void)
{
    run_all("tests/scenes/*.json", fuzz_scene);
    run_all("tests/scenes/bad/*.json", fuzz_scene);
    run_all("tests/scenes/bad/*.obj", fuzz_obj);
    run_all("tests/scenes/bad/*.mtl", fuzz_mtl);
}

/* Steps of paths put together at random lead to a value now and then, and almost never to one of its kind. */
static void edit_should_keep_its_promises_on_ten_thousand_wrong_paths(void)
{
    static const char *const pieces[] = {
        "camera",  "position", "screen",  "columns", "lights", "materials", "light grey",
        "objects", "faces",    "shading", "[0]",     "[3]",    "[-1]",      "[99999999999999999999]",
        "[\"",     "\"]",      ".",       ".",       "[",      "]",         "\"",
        "\\",      "{",        ",",       "=",       "\x1B",   "\xC2\x9B",  "\xFF",
        "$schema", "//"};
    enum { PIECES = sizeof pieces / sizeof *pieces, WRONG = 10000 };
    uint64_t state = 1;
    long before = fuzz_edit_refused;
    for (int i = 0; fuzz_edit_refused - before < WRONG; i++) {
        char line[256] = "";
        for (uint64_t left = random_next(&state) % 8; left > 0; left--)
            strcat(line, pieces[random_next(&state) % PIECES]);
        strcat(line, i % 3 ? "=1" : "=[0, 0, 1]");
        fuzz_edit((const uint8_t *)line, strlen(line));
        TEST_ASSERT_LESS_THAN(2 * WRONG, i);
    }
}

#define RUN_TEST_OF(name) RUN_TEST(name##_should_keep_its_promises_on_every_kept_input);

int main(void)
{
    UNITY_BEGIN();
    FUZZ_TARGETS(RUN_TEST_OF)
    RUN_TEST(scene_should_keep_its_promises_on_every_test_scene);
    RUN_TEST(edit_should_keep_its_promises_on_ten_thousand_wrong_paths);
    return UNITY_END();
}
