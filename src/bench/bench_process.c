/* Whole processes: what a user waits for. This program starts itself, with a kernel cache that is empty (cold) or
 * was filled by the run before (warm), and reads the phases from --stats=json. */
#include "bench/bench_process.h"

#include "base/process.h"
#include "bench/bench_measure.h"

#include <cjson/cJSON.h>
#include <string.h>
#include <unistd.h>

/* --- Ours --- */

/* The path of the running program. */
static const char *own_path(char *path, size_t size)
{
    ssize_t length = readlink("/proc/self/exe", path, size - 1);
    if (length <= 0)
        return "rectray";
    path[length] = '\0';
    return path;
}

/* One process, or the median of some. */
typedef struct Run {
    BenchPhases phases;
    double wall_ms, peak_bytes;
    int faces;
} Run;

static bool read_phases(const char *line, Run *run)
{
    BenchPhases *phases = &run->phases;
    const struct {
        const char *name;
        double *value;
    } fields[] = {{"parse", &phases->parse},       {"build", &phases->build},   {"device", &phases->device},
                  {"compile", &phases->compile},   {"upload", &phases->upload}, {"trace", &phases->trace},
                  {"readback", &phases->readback}, {"encode", &phases->encode}, {"total", &phases->total}};
    cJSON *json = cJSON_Parse(line);
    const cJSON *object = cJSON_GetObjectItem(json, "phases_ms"),
                *peak = cJSON_GetObjectItem(json, "peak_memory_bytes"), *faces = cJSON_GetObjectItem(json, "faces");
    bool ok = object && peak && faces;
    for (size_t i = 0; i < sizeof fields / sizeof *fields && ok; i++)
        *fields[i].value = cJSON_GetNumberValue(cJSON_GetObjectItem(object, fields[i].name));
    if (ok) {
        run->peak_bytes = cJSON_GetNumberValue(peak);
        run->faces = (int)cJSON_GetNumberValue(faces);
    }
    cJSON_Delete(json);
    return ok;
}

/* The options of `render` that ask for these settings. */
typedef struct SettingWords {
    char text[9][32];
    int count;
} SettingWords;

static void add_word(SettingWords *words, const char *option, const char *value)
{
    snprintf(words->text[words->count++], sizeof *words->text, "--%s=%s", option, value);
}

static void add_number(SettingWords *words, const char *option, double value)
{
    snprintf(words->text[words->count++], sizeof *words->text, "--%s=%.9g", option, value);
}

static SettingWords words_of(const RenderSettings *settings)
{
    SettingWords words = {.count = 0};
    add_word(&words, "precision", render_precisions[settings->precision]);
    add_word(&words, "kernel", render_kernels[settings->kernel]);
    add_word(&words, "accel", render_accels[settings->accel]);
    add_word(&words, "arithmetic", render_arithmetics[settings->arithmetic]);
    if (settings->arithmetic == ARITHMETIC_TEXTBOOK)
        add_number(&words, "shift", (double)settings->shift);
    if (settings->device >= 0)
        add_number(&words, "device", settings->device);
    if (settings->threads > 0)
        add_number(&words, "threads", settings->threads);
    if (settings->lanes > 0)
        add_number(&words, "lanes", settings->lanes);
    return words;
}

static bool render_process(const BenchScene *scene, const BenchPlan *plan, Run *run, Error *error)
{
    char program[1024], size[32], grid[16], line[8192];
    SettingWords words = words_of(&plan->settings);
    snprintf(size, sizeof size, "--size=%dx%d", scene->columns, scene->rows);
    snprintf(grid, sizeof grid, "--grid=%d", scene->grid);
    /* Both caches of kernels: see kernel_cache.h, and PoCL's manual. */
    BenchPath own_cache = bench_path(&plan->folder, "RECTRAY_CACHE_DIR=", "cache/kernels"),
              driver_cache = bench_path(&plan->folder, "POCL_CACHE_DIR=", "cache/driver"),
              picture = bench_path(&plan->folder, "", "picture.png");
    const char *argv[24] = {"env",
                            own_cache.text,
                            driver_cache.text,
                            own_path(program, sizeof program),
                            "render",
                            scene->path,
                            size,
                            grid,
                            "--quiet",
                            "--stats=json",
                            "-o",
                            picture.text};
    int count = 12;
    for (int i = 0; i < words.count; i++)
        argv[count++] = words.text[i];
    if (!process_run(argv, line, sizeof line, &run->wall_ms, error))
        return false;
    return read_phases(line, run) || error_set(error, ERROR_SYSTEM, "render told no statistics");
}

static bool empty_cache(const BenchFolder *folder, Error *error)
{
    BenchPath cache = bench_path(folder, "", "cache");
    const char *empty[] = {"rm", "-rf", "--", cache.text, NULL}, *make[] = {"mkdir", "--", cache.text, NULL};
    double ms;
    return process_run(empty, NULL, 0, &ms, error) && process_run(make, NULL, 0, &ms, error);
}

/* The run whose wall-clock time is the median stands for all
 * of them: its phases add up. The memory is the last one's. */
static bool median_process(const BenchScene *scene, const BenchPlan *plan, bool cold, int repeats, Run *median,
                           Error *error)
{
    Run runs[BENCH_MAX_REPEATS];
    double sorted[BENCH_MAX_REPEATS];
    repeats |= 1; /* odd, so that one of them is the median */
    for (int i = 0; i < repeats; i++) {
        if (cold && !empty_cache(&plan->folder, error))
            return false;
        if (!render_process(scene, plan, &runs[i], error))
            return false;
        sorted[i] = runs[i].wall_ms;
    }
    double wall_ms = bench_median(sorted, repeats);
    for (int i = 0; i < repeats; i++)
        if (runs[i].wall_ms == wall_ms)
            *median = runs[i];
    median->peak_bytes = runs[repeats - 1].peak_bytes;
    return true;
}

bool bench_process_warm(BenchProcess *result, const BenchScene *scene, const BenchPlan *plan, Error *error)
{
    Run warm = {0};
    if (!median_process(scene, plan, false, plan->repeats, &warm, error))
        return false;
    result->scene = *scene;
    result->warm = warm.phases;
    result->warm_wall_ms = warm.wall_ms;
    result->peak_bytes = warm.peak_bytes;
    result->faces = warm.faces;
    return true;
}

bool bench_process(BenchProcess *result, const BenchScene *scene, const BenchPlan *plan, Error *error)
{
    Run cold = {0};
    *result = (BenchProcess){.scene = *scene};
    if (!median_process(scene, plan, true, plan->repeats / 2, &cold, error))
        return false;
    result->cold = cold.phases;
    result->cold_wall_ms = cold.wall_ms;
    return bench_process_warm(result, scene, plan, error);
}

/* --- POV-Ray --- */

static bool export_scene(const char *path, const char *exported, Error *error)
{
    static const char command[] = BENCH_EXPORT " \"$1\" > \"$2\"";
    const char *argv[] = {"sh", "-c", command, "sh", path, exported, NULL};
    double ms;
    return process_run(argv, NULL, 0, &ms, error);
}

bool bench_povray(BenchProcess *result, const BenchPlan *plan, Error *error)
{
    const char *find[] = {"sh", "-c", "command -v povray", NULL};
    double times[BENCH_MAX_REPEATS], ms;
    Error missing = {0};
    if (access(BENCH_EXPORT, X_OK) != 0 || !process_run(find, NULL, 0, &ms, &missing))
        return true;
    int repeats = plan->repeats < 3 ? plan->repeats : 3;
    BenchPath scene = bench_path(&plan->folder, "", "scene.pov"), input = bench_path(&plan->folder, "+I", "scene.pov"),
              output = bench_path(&plan->folder, "+O", "povray.png");
    char columns[16], rows[16];
    snprintf(columns, sizeof columns, "+W%d", result->scene.columns);
    snprintf(rows, sizeof rows, "+H%d", result->scene.rows);
    const char *argv[] = {"povray", input.text, output.text, columns, rows, "-A", "-D", "-V", "-GA", NULL};
    if (!export_scene(result->scene.path, scene.text, error))
        return false;
    for (int i = 0; i < repeats; i++)
        if (!process_run(argv, NULL, 0, &times[i], error))
            return false;
    result->povray_wall_ms = bench_median(times, repeats);
    return true;
}
