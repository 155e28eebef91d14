/* What bench makes of measured figures, which are given here; a rung of the ladder; POV-Ray, played by the shell. */
#include "bench/bench_ladder.h"
#include "bench/bench_report.h"
#include "reader/scene_json.h"

#include "unity.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

static char home[1024], folder[64];
static Bench *bench;
static Error error;

void setUp(void)
{
    error = (Error){0};
    strcpy(folder, "/tmp/rectray-report-XXXXXX");
    TEST_ASSERT_NOT_NULL(getcwd(home, sizeof home));
    TEST_ASSERT_NOT_NULL(mkdtemp(folder));
    TEST_ASSERT_EQUAL_INT(0, chdir(folder));
    bench = calloc(1, sizeof *bench);
    TEST_ASSERT_NOT_NULL(bench);
    bench->plan.repeats = 2;
    TEST_ASSERT_TRUE(bench_folder_open(&bench->plan.folder, "files", &error));
}

void tearDown(void)
{
    char command[128];
    free(bench);
    TEST_ASSERT_EQUAL_INT(0, chdir(home));
    snprintf(command, sizeof command, "rm -rf %s", folder);
    TEST_ASSERT_EQUAL_INT(0, system(command));
}

/* A city of 6 006 faces: 2 ms beside the peer's 5. */
static BenchTrace city(void)
{
    return (BenchTrace){.scene = {.name = "city-1k"},
                        .faces = 6006,
                        .has_peer = true,
                        .peer = "sham",
                        .trace_ms = 2,
                        .build_ms = 4,
                        .fastest_ms = 1.5,
                        .slowest_ms = 3,
                        .primary_ms = 1,
                        .unmirrored_ms = 1.75,
                        .unmirrored_shadow = 1500000,
                        .peer_trace_ms = 5,
                        .peer_build_ms = 8,
                        .peer_share = 0.75,
                        .peer_bytes = 600600,
                        .differing = 7,
                        .far_off = 3,
                        .skips[SKIP_TREE] = {1, 2, 3, true},
                        .report.device_bytes = 1201200,
                        .report.rays = {.primary = 2000000, .shadow = 1600000, .reflection = 400000}};
}

static const char *contents(const char *path)
{
    static char text[8192];
    FILE *file = fopen(path, "r");
    TEST_ASSERT_NOT_NULL(file);
    text[fread(text, 1, sizeof text - 1, file)] = '\0';
    fclose(file);
    return text;
}

static const char *markdown(void)
{
    FILE *out = fopen("page.md", "w");
    TEST_ASSERT_NOT_NULL(out);
    bench_print_markdown(out, bench);
    fclose(out);
    return contents("page.md");
}

static void tables_should_reckon_ratios_and_rates(void)
{
    bench->traces[bench->trace_count++] = city();
    const char *page = markdown();
    TEST_ASSERT_NOT_NULL(strstr(page, "| city-1k | 6006 | 2.00 | 1.5 to 3.0 | 5.00 | 2.50 | 2000 | 25 % | 7, 3 |\n"));
    TEST_ASSERT_NOT_NULL(strstr(page, "The geometric mean of the ratios is **2.50**."));
    /* 2 million in 1 ms; 1.5 million in 0.75; 0.4 and 0.1 million of their shadow rays in 0.25. */
    TEST_ASSERT_NOT_NULL(strstr(page, "| 2000000 | 1600000 | 400000 | 2000 | 2000 | 2000 |"));
    TEST_ASSERT_NOT_NULL(strstr(page, "| city-1k | 6006 | 4.00 | 8.00 | 0.50 | 200 | 100 |\n"));
    TEST_ASSERT_NOT_NULL(strstr(page, "| city-1k | `tree` | 1 | 2.00 | 3.00 | 1.50 | the same |\n"));
}

static void what_was_not_measured_should_be_a_dash(void)
{
    BenchTrace alone = city();
    alone.has_peer = false;
    alone.peer_trace_ms = alone.peer_build_ms = alone.peer_bytes = 0;
    bench->traces[bench->trace_count++] = alone;
    const char *page = markdown();
    TEST_ASSERT_NOT_NULL(strstr(page, "| city-1k | 6006 | 2.00 | 1.5 to 3.0 | - | - | 2000 | - | - |\n"));
    TEST_ASSERT_NULL(strstr(page, "geometric mean"));
}

static void scaling_should_be_a_table_and_columns(void)
{
    bench->scaling[bench->scaling_count++] = city();
    bench->traces[bench->trace_count++] = city();
    bench->traces[0].has_peer = false;
    TEST_ASSERT_NOT_NULL(strstr(markdown(), "| 6006 | 2.00 | 5.00 | 2.50 | 4.00 | 8.00 |\n"));
    TEST_ASSERT_TRUE(bench_write_plot_data(bench, &error));
    TEST_ASSERT_NOT_NULL(strstr(contents("files/scaling.dat"), "\ncity-1k 6006 2.0000 5.0000 4.0000 8.0000\n"));
    TEST_ASSERT_NOT_NULL(strstr(contents("files/ladder.dat"), "\ncity-1k 6006 2.0000 -1.0000 4.0000 -1.0000\n"));
}

/* A process of 6 006 faces that takes 100 ms and 600.6 kB. */
static void processes_should_have_their_memory_per_face(void)
{
    const BenchProcess process = {
        .scene = {.name = "city-1k", .columns = 8, .rows = 6},
        .cold_wall_ms = 5000,
        .warm_wall_ms = 100,
        .povray_wall_ms = 2000,
        .warm = {.parse = 10, .build = 20, .upload = 5, .trace = 40, .encode = 8, .total = 95},
        .peak_bytes = 600600,
        .faces = 6006};
    bench->processes[bench->process_count++] = process;
    bench->curve[bench->curve_count++] = process;
    const char *page = markdown();
    TEST_ASSERT_NOT_NULL(strstr(page, "| city-1k | 8 x 6 | 5000 | 100 | 2000 | 20.0 | 0.57 | 100 |\n"));
    TEST_ASSERT_NOT_NULL(strstr(page, "| 6006 | 10.0 | 20.0 | 5.00 | 40.0 | 8.00 | 100 | 0.57 | 100 |\n"));
    TEST_ASSERT_TRUE(bench_write_plot_data(bench, &error));
    TEST_ASSERT_NOT_NULL(
        strstr(contents("files/process.dat"), "\ncity-1k 6006 10.0000 20.0000 5.0000 40.0000 100.0000 600600\n"));
}

static void columns_that_cannot_be_written_should_be_told_of(void)
{
    TEST_ASSERT_EQUAL_INT(0, mkdir("files/ladder.dat", 0700));
    TEST_ASSERT_FALSE(bench_write_plot_data(bench, &error));
    TEST_ASSERT_EQUAL_INT(ERROR_SYSTEM, error.kind);
    TEST_ASSERT_NOT_NULL(strstr(error.text, "cannot write files/ladder.dat"));
}

static void a_rung_should_be_a_scene_of_its_size(void)
{
    BenchScene scene;
    const BenchRung *rung = bench_ladder;
    while (strcmp(rung->name, "menger-2") != 0)
        rung++;
    TEST_ASSERT_TRUE(bench_rung(rung, &bench->plan.folder, &scene, &error));
    TEST_ASSERT_TRUE(bench_settle(&scene, &bench->plan, &error));
    Scene loaded;
    TEST_ASSERT_TRUE(scene_load(&loaded, scene.path, &error));
    TEST_ASSERT_EQUAL_INT(1056, loaded.face_count);
    scene_free(&loaded);
    TEST_ASSERT_TRUE(bench_rung(bench_ladder, &bench->plan.folder, &scene, &error));
    TEST_ASSERT_EQUAL_STRING("scenes/original.json", scene.path);
}

/* An executable file of one line of shell. */
static void script(const char *path, const char *line)
{
    FILE *file = fopen(path, "w");
    TEST_ASSERT_NOT_NULL(file);
    fprintf(file, "#!/bin/sh\n%s\n", line);
    fclose(file);
    TEST_ASSERT_EQUAL_INT(0, chmod(path, 0755));
}

static void povray_should_be_timed_where_it_and_its_export_are(void)
{
    BenchProcess result = {.scene = {.path = "a.json", .columns = 8, .rows = 6}};
    TEST_ASSERT_TRUE(bench_povray(&result, &bench->plan, &error)); /* no export */
    TEST_ASSERT_EQUAL_DOUBLE(0, result.povray_wall_ms);

    mkdir("build", 0700);
    mkdir("build/peers", 0700);
    script(BENCH_EXPORT, "echo \"scene $1\"");
    script("povray", "echo \"$@\" >> arguments");
    char path[sizeof home + 256];
    const char *old = getenv("PATH");
    snprintf(path, sizeof path, "%s:%s", folder, old);
    setenv("PATH", path, 1);
    TEST_ASSERT_TRUE(bench_povray(&result, &bench->plan, &error));
    TEST_ASSERT_TRUE(result.povray_wall_ms > 0);
    TEST_ASSERT_EQUAL_STRING("scene a.json\n", contents("files/scene.pov"));
    const char *words = "+Ifiles/scene.pov +Ofiles/povray.png +W8 +H6 -A -D -V -GA\n";
    TEST_ASSERT_EQUAL_INT(2 * strlen(words), strlen(contents("arguments"))); /* two repeats */
    TEST_ASSERT_EQUAL_INT(0, strncmp(contents("arguments"), words, strlen(words)));

    script("povray", "exit 1");
    TEST_ASSERT_FALSE(bench_povray(&result, &bench->plan, &error));
    TEST_ASSERT_NOT_NULL(strstr(error.text, "povray failed"));
    setenv("PATH", path + strlen(folder) + 1, 1);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(tables_should_reckon_ratios_and_rates);
    RUN_TEST(what_was_not_measured_should_be_a_dash);
    RUN_TEST(scaling_should_be_a_table_and_columns);
    RUN_TEST(processes_should_have_their_memory_per_face);
    RUN_TEST(columns_that_cannot_be_written_should_be_told_of);
    RUN_TEST(a_rung_should_be_a_scene_of_its_size);
    RUN_TEST(povray_should_be_timed_where_it_and_its_export_are);
    return UNITY_END();
}
