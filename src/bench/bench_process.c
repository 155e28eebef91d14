/* Whole processes: what a user waits for. This program starts itself, with a kernel cache that is empty (cold) or
 * was filled by the run before (warm), and reads the phases from --stats=json. */
#include "bench/bench.h"

#include "reader/generate.h"
#include "base/process.h"

#include <cjson/cJSON.h>
#include <errno.h>
#include <string.h>
#include <unistd.h>

bool bench_generate(BenchScene *scene, const char *kind_name, int size, const BenchFolder *folder, Error *error)
{
    const SceneKind *kind = scene_kind_find(kind_name, error);
    if (!kind)
        return false;
    snprintf(scene->path, sizeof scene->path, "%s/%s-%d.json", folder->path, kind_name, size);
    FILE *out = fopen(scene->path, "w");
    bool made = out && scene_generate(kind, out, size, 0, error);
    if (out && fclose(out) == 0 && made)
        return true;
    return error_set(error, ERROR_SYSTEM, "cannot write %s: %s", scene->path, strerror(errno));
}

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

static bool read_phases(const char *line, BenchPhases *phases, double *peak_bytes)
{
    const struct {
        const char *name;
        double *value;
    } fields[] = {{"parse", &phases->parse},       {"build", &phases->build},   {"device", &phases->device},
                  {"compile", &phases->compile},   {"upload", &phases->upload}, {"trace", &phases->trace},
                  {"readback", &phases->readback}, {"encode", &phases->encode}, {"total", &phases->total}};
    cJSON *json = cJSON_Parse(line);
    const cJSON *object = cJSON_GetObjectItem(json, "phases_ms"),
                *peak = cJSON_GetObjectItem(json, "peak_memory_bytes");
    bool ok = object && peak;
    for (size_t i = 0; i < sizeof fields / sizeof *fields && ok; i++)
        *fields[i].value = cJSON_GetNumberValue(cJSON_GetObjectItem(object, fields[i].name));
    if (ok)
        *peak_bytes = cJSON_GetNumberValue(peak);
    cJSON_Delete(json);
    return ok;
}

static bool render_process(const BenchScene *scene, const BenchFolder *folder, BenchPhases *phases, double *wall_ms,
                           double *peak_bytes, Error *error)
{
    char program[1024], size[32], grid[16], line[8192];
    snprintf(size, sizeof size, "--size=%dx%d", scene->columns, scene->rows);
    snprintf(grid, sizeof grid, "--grid=%d", scene->grid);
    /* Both caches of kernels: see opencl_cache.h, and PoCL's manual. */
    BenchPath own_cache = bench_path(folder, "RECTRAY_CACHE_DIR=", "cache/kernels"),
              driver_cache = bench_path(folder, "POCL_CACHE_DIR=", "cache/driver"),
              picture = bench_path(folder, "", "picture.png");
    const char *argv[] = {"env",
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
                          picture.text,
                          NULL};
    if (!process_run(argv, line, sizeof line, wall_ms, error))
        return false;
    return read_phases(line, phases, peak_bytes) || error_set(error, ERROR_SYSTEM, "render told no statistics");
}

static bool empty_cache(const BenchFolder *folder, Error *error)
{
    BenchPath cache = bench_path(folder, "", "cache");
    const char *empty[] = {"rm", "-rf", "--", cache.text, NULL}, *make[] = {"mkdir", "--", cache.text, NULL};
    double ms;
    return process_run(empty, NULL, 0, &ms, error) && process_run(make, NULL, 0, &ms, error);
}

/* The run whose wall-clock time is the median stands for all of them: its phases add up. */
static bool median_process(const BenchScene *scene, const BenchFolder *folder, bool cold, int repeats,
                           BenchPhases *phases, double *wall_ms, double *peak_bytes, Error *error)
{
    BenchPhases all[BENCH_MAX_REPEATS];
    double walls[BENCH_MAX_REPEATS], sorted[BENCH_MAX_REPEATS];
    repeats |= 1; /* odd, so that one of them is the median */
    for (int i = 0; i < repeats; i++) {
        if (cold && !empty_cache(folder, error))
            return false;
        if (!render_process(scene, folder, &all[i], &walls[i], peak_bytes, error))
            return false;
        sorted[i] = walls[i];
    }
    *wall_ms = bench_median(sorted, repeats);
    for (int i = 0; i < repeats; i++)
        if (walls[i] == *wall_ms)
            *phases = all[i];
    return true;
}

bool bench_process(BenchProcess *result, const BenchScene *scene, const BenchPlan *plan, Error *error)
{
    *result = (BenchProcess){.scene = *scene};
    return median_process(scene, &plan->folder, true, plan->repeats / 2, &result->cold, &result->cold_wall_ms,
                          &result->peak_bytes, error) &&
           median_process(scene, &plan->folder, false, plan->repeats, &result->warm, &result->warm_wall_ms,
                          &result->peak_bytes, error);
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
