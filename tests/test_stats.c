/* --stats and the line of the progress. */
#include "command/progress.h"
#include "command/stats.h"

#include "unity.h"

#include <cjson/cJSON.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

void setUp(void) {}
void tearDown(void) {}

static const Stats STATS = {
    .report = {.build_ms = 1,
               .upload_ms = 2,
               .device_ms = 3,
               .compile_ms = 4,
               .trace_ms = 0.1,
               .readback_ms = 6,
               .rays = {18446744073709551615u, 9007199254740993u, 3},
               .box_tests = 4,
               .face_tests = 5,
               .skipped = {[SKIP_LIGHT_BEHIND] = 6},
               .lanes = 16,
               .accel = ACCEL_BVH,
               .device = "a \"device\"",
               .build_options = "-D A"},
    .parse_ms = 7,
    .encode_ms = 8,
    .total_ms = 1.0 / 3,
    .faces = 9,
    .lights = 10,
    .backend = BACKEND_OPENCL,
    .precision = PRECISION_FLOAT,
};

/* What stats_print writes; the caller frees it. */
static char *printed(StatsFormat format)
{
    Error error = {0};
    FILE *file = tmpfile();
    TEST_ASSERT_NOT_NULL(file);
    TEST_ASSERT_TRUE(stats_print(file, format, &STATS, &error));
    char *text = calloc(1, 8192);
    TEST_ASSERT_NOT_NULL(text);
    rewind(file);
    text[fread(text, 1, 8191, file)] = '\0';
    fclose(file);
    return text;
}

static void assert_number(const cJSON *object, const char *name, double number)
{
    const cJSON *item = cJSON_GetObjectItem(object, name);
    TEST_ASSERT_TRUE_MESSAGE(cJSON_IsNumber(item), name);
    TEST_ASSERT_TRUE_MESSAGE(item->valuedouble == number, name);
}

static void assert_string(const cJSON *object, const char *name, const char *text)
{
    TEST_ASSERT_EQUAL_STRING_MESSAGE(text, cJSON_GetStringValue(cJSON_GetObjectItem(object, name)), name);
}

static void stats_json_should_hold_every_key(void)
{
    char *text = printed(STATS_JSON);
    cJSON *json = cJSON_Parse(text);
    TEST_ASSERT_NOT_NULL(json);
    const cJSON *phases = cJSON_GetObjectItem(json, "phases_ms");
    const char *const names[] = {"build",    "upload", "device", "compile", "trace",
                                 "readback", "parse",  "encode", "total"};
    const double values[] = {1, 2, 3, 4, 0.1, 6, 7, 8, 1.0 / 3};
    for (int i = 0; i < 9; i++)
        assert_number(phases, names[i], values[i]);
    assert_number(cJSON_GetObjectItem(json, "rays"), "reflection", 3);
    assert_number(cJSON_GetObjectItem(json, "tests"), "box", 4);
    assert_number(cJSON_GetObjectItem(json, "tests"), "face", 5);
    assert_number(cJSON_GetObjectItem(json, "skipped"), "light_behind", 6);
    assert_number(json, "faces", 9);
    assert_number(json, "lights", 10);
    assert_number(json, "lanes", 16);
    TEST_ASSERT_TRUE(cJSON_GetObjectItem(json, "peak_memory_bytes")->valuedouble > 100000);
    assert_string(json, "device", "a \"device\"");
    assert_string(json, "backend", "opencl");
    assert_string(json, "precision", "float");
    assert_string(json, "accel", "bvh");
    assert_string(json, "build_options", "-D A");
    cJSON_Delete(json);
    free(text);
}

static void stats_json_should_keep_all_digits_on_one_line(void)
{
    char *text = printed(STATS_JSON);
    TEST_ASSERT_NOT_NULL(strstr(text, "\"primary\":18446744073709551615,"));
    TEST_ASSERT_NOT_NULL(strstr(text, "\"shadow\":9007199254740993,"));
    TEST_ASSERT_EQUAL_PTR(text + strlen(text) - 1, strchr(text, '\n'));
    free(text);
}

static void stats_text_should_show_counts_in_full(void)
{
    char *text = printed(STATS_TEXT);
    TEST_ASSERT_NOT_NULL(strstr(text, "trace                          0.100 ms\n"));
    TEST_ASSERT_NOT_NULL(strstr(text, "shadow rays           9007199254740993\n"));
    free(text);
}

static void stats_should_print_nothing_unasked(void)
{
    char *text = printed(STATS_NONE);
    TEST_ASSERT_EQUAL_STRING("", text);
    free(text);
}

static void stats_begin_should_know_that_the_reference_is_double(void)
{
    Scene scene = {.face_count = 3, .light_count = 2};
    Stats stats = stats_begin(&scene, BACKEND_REFERENCE, PRECISION_FLOAT);
    TEST_ASSERT_EQUAL_INT(PRECISION_DOUBLE, stats.precision);
    TEST_ASSERT_EQUAL_INT(3, stats.faces);
    TEST_ASSERT_EQUAL_INT(2, stats.lights);
    TEST_ASSERT_EQUAL_INT(PRECISION_FLOAT, stats_begin(&scene, BACKEND_OPENCL, PRECISION_FLOAT).precision);
}

/* Its line goes to stderr, which is a file meanwhile. */
static void progress_should_count_the_time_of_tracing_only(void)
{
    char text[128] = "";
    FILE *file = tmpfile();
    TEST_ASSERT_NOT_NULL(file);
    fflush(stderr);
    int kept = dup(STDERR_FILENO);
    dup2(fileno(file), STDERR_FILENO);
    Progress progress = progress_start(PROGRESS_ALWAYS, false);
    progress_step(&progress, 0.5, 3000000, 2000);
    fflush(stderr);
    dup2(kept, STDERR_FILENO);
    close(kept);
    rewind(file);
    TEST_ASSERT_NOT_NULL(fgets(text, sizeof text, file));
    fclose(file);
    TEST_ASSERT_EQUAL_STRING("\r50 %, 1.50 million rays/s, 0:02 left", text);
}

static void progress_line_should_tell_rate_and_time_left(void)
{
    char line[96];
    progress_line(line, sizeof line, 0.25, 4000000, 40);
    TEST_ASSERT_EQUAL_STRING("25 %, 0.10 million rays/s, 2:00 left", line);
    progress_line(line, sizeof line, 0.999, 1500000, 1);
    TEST_ASSERT_EQUAL_STRING("99 %, 1.50 million rays/s, 0:01 left", line);
    progress_line(line, sizeof line, 1, 0, 0);
    TEST_ASSERT_EQUAL_STRING("100 %, 0.00 million rays/s, 0:00 left", line);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(stats_json_should_hold_every_key);
    RUN_TEST(stats_json_should_keep_all_digits_on_one_line);
    RUN_TEST(stats_text_should_show_counts_in_full);
    RUN_TEST(stats_should_print_nothing_unasked);
    RUN_TEST(stats_begin_should_know_that_the_reference_is_double);
    RUN_TEST(progress_should_count_the_time_of_tracing_only);
    RUN_TEST(progress_line_should_tell_rate_and_time_left);
    return UNITY_END();
}
