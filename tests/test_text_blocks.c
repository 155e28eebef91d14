/* Files of text in blocks: whatever the ends of their lines are, and wherever a block ends. */
#include "base/text_blocks.h"

#include "unity.h"

#include <stdlib.h>
#include <string.h>
#include <unistd.h>

static char path[64];
static Error error;

void setUp(void)
{
    error = (Error){.kind = ERROR_NONE};
    snprintf(path, sizeof path, "/tmp/rectray-test-blocks-%ld", (long)getpid());
}

void tearDown(void)
{
    unlink(path);
}

static void write_file(const char *text, size_t length)
{
    FILE *file = fopen(path, "wb");
    TEST_ASSERT_NOT_NULL(file);
    TEST_ASSERT_EQUAL(length, fwrite(text, 1, length, file));
    fclose(file);
}

/* All blocks of the file, one behind the other; the caller frees it. */
static char *read_file(size_t *length, int *count)
{
    TextBlocks blocks;
    char *all = malloc(4 * (size_t)TEXT_BLOCK_MAX);
    TEST_ASSERT_NOT_NULL(all);
    TEST_ASSERT_TRUE(text_blocks_open(&blocks, path, &error));
    *length = 0;
    *count = 0;
    for (TextBlock block; (block = text_blocks_next(&blocks, &error)).at; ++*count) {
        size_t size = (size_t)(block.end - block.at);
        TEST_ASSERT_TRUE(size > 0 && block.end[-1] == '\n' && (size == 1 || block.end[-2] != '\\'));
        memcpy(all + *length, block.at, size);
        *length += size;
    }
    text_blocks_close(&blocks);
    return all;
}

static void assert_read(const char *text, const char *expected)
{
    size_t length;
    int count;
    write_file(text, strlen(text));
    char *all = read_file(&length, &count);
    TEST_ASSERT_EQUAL_MESSAGE(ERROR_NONE, error.kind, error.text);
    TEST_ASSERT_EQUAL(strlen(expected), length);
    TEST_ASSERT_EQUAL_MEMORY(expected, all, length);
    free(all);
}

static void ends_of_lines_should_become_one_kind(void)
{
    assert_read("a\nb\n", "a\nb\n");
    assert_read("a\r\nb\r\n", "a \nb \n");
    assert_read("a\rb\r", "a\nb\n");
    assert_read("a\r\rb\r\n\nc", "a\n\nb \n\nc\n");
    assert_read("a\\\r\nb\r", "a \\\nb\n");
    assert_read("\xEF\xBB\xBFv 1\n", "v 1\n");
}

static void the_last_line_should_have_an_end(void)
{
    assert_read("a", "a\n");
    assert_read("a\\", "a\\\n\n"); /* nothing continues it */
    assert_read("a\\\n", "a\\\n\n");
    size_t length;
    int count;
    write_file("", 0);
    free(read_file(&length, &count));
    TEST_ASSERT_EQUAL(0, count);
    TEST_ASSERT_EQUAL(ERROR_NONE, error.kind);
}

/* Lines of every kind of end, moved by a byte at a time against the end of the first block. */
static void blocks_should_end_between_lines(void)
{
    static const char in[] = "ab\\\r\ncd\r\nef\rgh\n", out[] = "ab \\\ncd \nef\ngh\n";
    enum { IN = sizeof in - 1, OUT = sizeof out - 1, COPIES = TEXT_BLOCK_MAX / IN + 100 };
    static char text[IN * COPIES + IN], expected[OUT * COPIES + IN];
    for (size_t shift = 0; shift < IN; shift++) {
        memset(text, 'x', shift);
        memset(expected, 'x', shift);
        for (size_t i = 0; i < COPIES; i++) {
            memcpy(text + shift + i * IN, in, IN);
            memcpy(expected + shift + i * OUT, out, OUT);
        }
        size_t length;
        int count;
        write_file(text, shift + (size_t)IN * COPIES);
        char *all = read_file(&length, &count);
        TEST_ASSERT_EQUAL(2, count);
        TEST_ASSERT_EQUAL(shift + (size_t)OUT * COPIES, length);
        TEST_ASSERT_EQUAL_MEMORY(expected, all, length);
        free(all);
    }
}

static void assert_fails(const char *text, size_t length, const char *reason)
{
    size_t got;
    int count;
    error = (Error){.kind = ERROR_NONE};
    write_file(text, length);
    free(read_file(&got, &count));
    TEST_ASSERT_EQUAL(ERROR_INPUT, error.kind);
    TEST_ASSERT_EQUAL_STRING(reason, error.text + strlen(path));
}

static void what_is_no_text_should_be_refused_with_its_line(void)
{
    assert_fails("a\nb\rc\0d\n", 8, ":3: a NUL byte; this is not a text file");
    assert_fails("\xFF\xFEv\0", 4, ":1: is UTF-16; save it as UTF-8");
    static char endless[TEXT_BLOCK_MAX + 1];
    memset(endless, 'x', sizeof endless);
    assert_fails(
        endless, sizeof endless,
        ":1: the line is longer than 1048576 bytes, with the lines that continue it; make several lines of it, "
        "or leave it out if it is a comment");
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(ends_of_lines_should_become_one_kind);
    RUN_TEST(the_last_line_should_have_an_end);
    RUN_TEST(blocks_should_end_between_lines);
    RUN_TEST(what_is_no_text_should_be_refused_with_its_line);
    return UNITY_END();
}
