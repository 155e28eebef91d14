/* Suggestions for mistyped words. */
#include "base/suggest.h"

#include "unity.h"

#include <stddef.h>

static const char *const COMMANDS[] = {"render", "cast", "check", "compare", "devices", NULL};

void setUp(void) {}
void tearDown(void) {}

static void nearest_word_should_mend_one_wrong_letter(void)
{
    TEST_ASSERT_EQUAL_STRING("render", suggest_word("rander", COMMANDS));
    TEST_ASSERT_EQUAL_STRING("devices", suggest_word("device", COMMANDS));
    TEST_ASSERT_EQUAL_STRING("check", suggest_word("checkk", COMMANDS));
}

static void nearest_word_should_count_a_swap_once(void)
{
    const char *const known[] = {"cat", NULL};
    TEST_ASSERT_EQUAL_STRING("cat", suggest_word("cta", known));
    TEST_ASSERT_EQUAL_STRING("render", suggest_word("ernedr", COMMANDS)); /* two swaps */
}

static void nearest_word_should_prefer_the_nearer_then_the_earlier(void)
{
    const char *const known[] = {"axxb", "axb", "ayb", NULL};
    TEST_ASSERT_EQUAL_STRING("axb", suggest_word("azb", known));
    TEST_ASSERT_EQUAL_STRING("ayb", suggest_word("ayb", known));
}

static void nearest_word_should_not_guess_wildly(void)
{
    TEST_ASSERT_NULL(suggest_word("photon", COMMANDS));
    TEST_ASSERT_NULL(suggest_word("", COMMANDS));
    TEST_ASSERT_NULL(suggest_word("renderrenderrenderrenderrenderrenderrenderrenderrender", COMMANDS));
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(nearest_word_should_mend_one_wrong_letter);
    RUN_TEST(nearest_word_should_count_a_swap_once);
    RUN_TEST(nearest_word_should_prefer_the_nearer_then_the_earlier);
    RUN_TEST(nearest_word_should_not_guess_wildly);
    return UNITY_END();
}
