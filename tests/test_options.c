/* The command line: what is taken, what is refused, and what the refusal says. */
#include "command/options.h"

#include "unity.h"

#include <string.h>

static const Command COMMANDS[] = {
    {.name = "render", .operands = "SCENE", .operands_min = 1, .operands_max = 1},
    {.name = "cast", .operands = "SCENE", .operands_min = 1, .operands_max = 1},
    {.name = "check", .operands = "SCENE", .operands_min = 1, .operands_max = 1},
    {.name = "compare", .operands = "A B", .operands_min = 2, .operands_max = 2},
    {0},
};

static Options options;
static Error error;
static char words[256];

void setUp(void)
{
    error = (Error){0};
}

void tearDown(void) {}

/* Parses a line of words, of which the first is the command. */
static bool parse(const char *line)
{
    static char *argv[17]; /* the options point into it */
    int argc = 0;
    strcpy(words, line);
    for (char *word = strtok(words, " "); word; word = strtok(NULL, " "))
        argv[argc++] = word;
    argv[argc] = NULL;
    error = (Error){0};
    return options_parse(&options, options_find_command(COMMANDS, argv[0], &error), argc, argv, &error);
}

static void assert_refused(const char *line, const char *message)
{
    TEST_ASSERT_FALSE_MESSAGE(parse(line), line);
    TEST_ASSERT_EQUAL_INT(ERROR_USAGE, error.kind);
    TEST_ASSERT_EQUAL_STRING(message, error.text);
}

static void options_should_leave_the_scene_s_own_where_nothing_is_said(void)
{
    TEST_ASSERT_TRUE(parse("render a.json"));
    TEST_ASSERT_EQUAL_INT(1, options.operand_count);
    TEST_ASSERT_EQUAL_STRING("a.json", options.operands[0]);
    TEST_ASSERT_NULL(options.output);
    TEST_ASSERT_EQUAL_INT(BACKEND_OPENCL, options.backend);
    TEST_ASSERT_EQUAL_INT(PRECISION_FLOAT, options.settings.precision);
    TEST_ASSERT_EQUAL_INT(ACCEL_AUTO, options.settings.accel);
    TEST_ASSERT_EQUAL_INT(-1, options.settings.device);
    TEST_ASSERT_EQUAL_INT(0, options.settings.lanes);
    TEST_ASSERT_EQUAL_INT(0, options.settings.threads);
    TEST_ASSERT_EQUAL_INT(0, options.columns);
    TEST_ASSERT_EQUAL_INT(0, options.grid);
    TEST_ASSERT_EQUAL_INT(-1, options.bounces);
    TEST_ASSERT_EQUAL_INT(STATS_NONE, options.stats);
    TEST_ASSERT_EQUAL_INT(PROGRESS_AUTO, options.progress);
    TEST_ASSERT_FALSE(options.quiet || options.help || options.version || options.geometry || options.precision_given);
}

static void options_should_be_taken_before_and_after_the_operand(void)
{
    TEST_ASSERT_TRUE(parse("render --backend reference a.json -o b.png --size=64x48 -g 2 --bounces 0 -t 3 -q"));
    TEST_ASSERT_EQUAL_INT(BACKEND_REFERENCE, options.backend);
    TEST_ASSERT_EQUAL_STRING("b.png", options.output);
    TEST_ASSERT_EQUAL_INT(64, options.columns);
    TEST_ASSERT_EQUAL_INT(48, options.rows);
    TEST_ASSERT_EQUAL_INT(2, options.grid);
    TEST_ASSERT_EQUAL_INT(0, options.bounces);
    TEST_ASSERT_EQUAL_INT(3, options.settings.threads);
    TEST_ASSERT_TRUE(options.quiet);
    TEST_ASSERT_TRUE(parse("render --device 1 --precision double --accel bvh --lanes 16 --progress never a.json"));
    TEST_ASSERT_EQUAL_INT(1, options.settings.device);
    TEST_ASSERT_EQUAL_INT(PRECISION_DOUBLE, options.settings.precision);
    TEST_ASSERT_EQUAL_INT(ACCEL_BVH, options.settings.accel);
    TEST_ASSERT_EQUAL_INT(16, options.settings.lanes);
    TEST_ASSERT_EQUAL_INT(PROGRESS_NEVER, options.progress);
}

static void options_should_take_an_operand_that_looks_like_an_option_after_two_dashes(void)
{
    TEST_ASSERT_TRUE(parse("render -q -- --help"));
    TEST_ASSERT_EQUAL_STRING("--help", options.operands[0]);
    TEST_ASSERT_FALSE(options.help);
}

static void options_should_take_stats_with_and_without_a_format(void)
{
    TEST_ASSERT_TRUE(parse("render a.json --stats"));
    TEST_ASSERT_EQUAL_INT(STATS_TEXT, options.stats);
    TEST_ASSERT_TRUE(parse("render a.json --stats=text"));
    TEST_ASSERT_EQUAL_INT(STATS_TEXT, options.stats);
    TEST_ASSERT_TRUE(parse("render a.json --stats=json"));
    TEST_ASSERT_EQUAL_INT(STATS_JSON, options.stats);
    assert_refused("render a.json --stats=xml", "--stats 'xml': expected text or json");
}

static void options_should_take_the_limits_of_a_number_and_nothing_beyond(void)
{
    TEST_ASSERT_TRUE(parse("render a --size 1x16384 --grid 16 --bounces 64 --threads 256 --device 0"));
    TEST_ASSERT_EQUAL_INT(16384, options.rows);
    assert_refused("render a --size 0x1", "--size '0x1': expected two whole numbers from 1 to 16384, such as 640x480");
    assert_refused("render a --size 1x16385",
                   "--size '1x16385': expected two whole numbers from 1 to 16384, such as 640x480");
    assert_refused("render a --grid 0", "--grid '0': expected a whole number from 1 to 16");
    assert_refused("render a --grid 17", "--grid '17': expected a whole number from 1 to 16");
    assert_refused("render a --bounces 65", "--bounces '65': expected a whole number from 0 to 64");
    assert_refused("render a --threads 0", "--threads '0': expected a whole number from 1 to 256");
    assert_refused("compare a b --tolerance 256", "--tolerance '256': expected a whole number from 0 to 255");
    assert_refused("render a --grid 99999999999999999999",
                   "--grid '99999999999999999999': expected a whole number from 1 to 16");
}

static void options_should_refuse_what_only_begins_like_a_number(void)
{
    static const char *const sizes[] = {"640",      "640x",     "x480",     "640X480",
                                        "640x480x", "640x-480", "+640x480", "6e2x480"};
    char line[64];
    for (size_t i = 0; i < sizeof sizes / sizeof *sizes; i++) {
        snprintf(line, sizeof line, "render a --size %s", sizes[i]);
        TEST_ASSERT_FALSE_MESSAGE(parse(line), line);
    }
    static const char *const numbers[] = {
        "--grid=",        "--grid=2x",   "--grid=2.0",       "--grid=0x2",   "--grid=-1",
        "--lanes=2",      "--lanes=016", "--backend=OpenCL", "--accel=tree", "--precision=half",
        "--progress=yes", "--output=",   "--device=-1"};
    for (size_t i = 0; i < sizeof numbers / sizeof *numbers; i++) {
        snprintf(line, sizeof line, "render a %s", numbers[i]);
        TEST_ASSERT_FALSE_MESSAGE(parse(line), line);
        TEST_ASSERT_EQUAL_INT(ERROR_USAGE, error.kind);
    }
}

static void options_should_name_a_missing_value(void)
{
    assert_refused("render a --size", "--size needs a value: two whole numbers from 1 to 16384, such as 640x480");
    assert_refused("render a --sampling adaptive:17",
                   "--sampling 'adaptive:17': expected uniform, uniform:N, adaptive or adaptive:N, N from 1 to 16");
    assert_refused("render a --sampling uniform:",
                   "--sampling 'uniform:': expected uniform, uniform:N, adaptive or adaptive:N, N from 1 to 16");
    assert_refused("render a --sampling adapt",
                   "--sampling 'adapt': expected uniform, uniform:N, adaptive or adaptive:N, N from 1 to 16");
    assert_refused("render a -o", "--output needs a value: the name of a file, or - for standard output");
    assert_refused("render a --quiet=1", "--quiet takes no value");
}

static void options_should_suggest_the_nearest_of_the_command(void)
{
    assert_refused("render a --sise 3", "render has no option --sise; did you mean --size?");
    assert_refused("render a --sise=3", "render has no option --sise; did you mean --size?");
    assert_refused("check a --geometri", "check has no option --geometri; did you mean --geometry?");
    assert_refused("render a --frobnicate",
                   "render has no option --frobnicate; `rectray render --help` lists its options");
    assert_refused("render a -z", "render has no option -z; `rectray render --help` lists its options");
    assert_refused("render a --pr float", "--pr could be --precision or --progress");
}

static void options_should_refuse_those_of_other_commands(void)
{
    assert_refused("check a --size 3x3",
                   "check takes no --size; that is an option of: render trace explore bench grade generate");
    assert_refused("check a -s 3x3",
                   "check takes no --size; that is an option of: render trace explore bench grade generate");
    assert_refused(
        "cast a --output b",
        "cast takes no --output; that is an option of: render explore trace frame generate compare bench tree join");
}

static void options_should_be_known_by_their_unambiguous_beginning(void)
{
    TEST_ASSERT_TRUE(parse("render a --back reference --prec double"));
    TEST_ASSERT_EQUAL_INT(BACKEND_REFERENCE, options.backend);
}

static void options_should_count_the_operands(void)
{
    assert_refused("render", "render needs SCENE; `rectray render --help` tells more");
    assert_refused("render a b", "render does not know what to do with 'b'; `rectray render --help` tells more");
    assert_refused("compare a", "compare needs A B; `rectray compare --help` tells more");
    TEST_ASSERT_TRUE(parse("render --help"));
    TEST_ASSERT_TRUE(options.help);
    TEST_ASSERT_TRUE(parse("render --version"));
    TEST_ASSERT_TRUE(options.version);
}

static void command_find_should_suggest_the_nearest(void)
{
    TEST_ASSERT_EQUAL_PTR(&COMMANDS[3], options_find_command(COMMANDS, "compare", &error));
    TEST_ASSERT_NULL(options_find_command(COMMANDS, "compar", &error));
    TEST_ASSERT_EQUAL_STRING("there is no command 'compar'; did you mean 'compare'?", error.text);
    error = (Error){0};
    TEST_ASSERT_NULL(options_find_command(COMMANDS, "photograph", &error));
    TEST_ASSERT_EQUAL_STRING("there is no command 'photograph'; `rectray --help` lists them", error.text);
    TEST_ASSERT_EQUAL_INT(ERROR_USAGE, error.kind);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(options_should_leave_the_scene_s_own_where_nothing_is_said);
    RUN_TEST(options_should_be_taken_before_and_after_the_operand);
    RUN_TEST(options_should_take_an_operand_that_looks_like_an_option_after_two_dashes);
    RUN_TEST(options_should_take_stats_with_and_without_a_format);
    RUN_TEST(options_should_take_the_limits_of_a_number_and_nothing_beyond);
    RUN_TEST(options_should_refuse_what_only_begins_like_a_number);
    RUN_TEST(options_should_name_a_missing_value);
    RUN_TEST(options_should_suggest_the_nearest_of_the_command);
    RUN_TEST(options_should_refuse_those_of_other_commands);
    RUN_TEST(options_should_be_known_by_their_unambiguous_beginning);
    RUN_TEST(options_should_count_the_operands);
    RUN_TEST(command_find_should_suggest_the_nearest);
    return UNITY_END();
}
