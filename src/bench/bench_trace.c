/* Tracing measured in one process. The peer runs as a process of its own that answers each line with the time of one
 * more picture. The two run alternately, so that both see the same load: one picture of ours, one of its, and so on. */
#include "bench/bench_trace.h"

#include "base/process.h"
#include "bench/bench_measure.h"
#include "bench/bench_scene.h"
#include "reader/scene_json.h"

#include <cjson/cJSON.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

/* --- The peer --- */

static BenchPath peer_picture(const BenchPlan *plan)
{
    return bench_path(&plan->folder, "", "peer.png");
}

static bool peer_reads(BenchTrace *result, const char *line)
{
    cJSON *json = cJSON_Parse(line);
    const cJSON *rays = cJSON_GetObjectItem(json, "rays"), *modes = cJSON_GetObjectItem(json, "modes");
    static const char *const kinds[] = {"primary", "shadow", "reflection"};
    uint64_t *counts[] = {&result->peer_rays.primary, &result->peer_rays.shadow, &result->peer_rays.reflection};
    bool ok = json && rays && modes;
    for (int i = 0; i < 3 && ok; i++) {
        const char *mode = cJSON_GetStringValue(cJSON_GetObjectItem(modes, kinds[i]));
        *counts[i] = (uint64_t)cJSON_GetNumberValue(cJSON_GetObjectItem(rays, kinds[i]));
        snprintf(result->peer_modes[i], sizeof result->peer_modes[i], "%s", *counts[i] > 0 && mode ? mode : "none");
    }
    const char *name = cJSON_GetStringValue(cJSON_GetObjectItem(json, "peer"));
    snprintf(result->peer, sizeof result->peer, "%s", name ? name : "peer");
    result->peer_build_ms = cJSON_GetNumberValue(cJSON_GetObjectItem(json, "build_ms"));
    result->peer_bytes = cJSON_GetNumberValue(cJSON_GetObjectItem(json, "build_bytes"));
    result->peer_share = cJSON_GetNumberValue(cJSON_GetObjectItem(json, "share_inside_embree"));
    cJSON_Delete(json);
    return ok;
}

/* Starts the peer where it is built, and lets it find its fastest way. */
static bool peer_start(Process *peer, BenchTrace *result, const BenchPlan *plan, Error *error)
{
    *peer = (Process){0};
    if (access(BENCH_PEER, X_OK) != 0)
        return true;
    char size[32], grid[16], line[2048];
    BenchPath picture = peer_picture(plan);
    snprintf(size, sizeof size, "%dx%d", result->scene.columns, result->scene.rows);
    snprintf(grid, sizeof grid, "%d", result->scene.grid);
    const char *argv[] = {BENCH_PEER, result->scene.path, "--size", size,         "--grid",
                          grid,       "--serve",          "-o",     picture.text, NULL};
    if (!process_start(peer, argv, error))
        return false;
    result->has_peer = fgets(line, sizeof line, peer->from) && peer_reads(result, line);
    return result->has_peer || error_set(error, ERROR_SYSTEM, "%s does not answer", BENCH_PEER);
}

static bool peer_trace(Process *peer, double *ms, Error *error)
{
    char line[64];
    fputs("\n", peer->to);
    fflush(peer->to);
    if (!fgets(line, sizeof line, peer->from))
        return error_set(error, ERROR_SYSTEM, "%s has ended", BENCH_PEER);
    *ms = strtod(line, NULL);
    return true;
}

/* Ends the peer, which then writes its picture, and counts where that differs from ours. */
static bool peer_finish(Process *peer, BenchTrace *result, const BenchPlan *plan, const Image *ours, Error *error)
{
    Image theirs = {0};
    if (!process_end(peer))
        return error_set(error, ERROR_SYSTEM, "%s failed", BENCH_PEER);
    if (!image_read(&theirs, peer_picture(plan).text, error))
        return false;
    for (long long i = 0; i < (long long)ours->columns * ours->rows; i++) {
        int largest = 0;
        for (int channel = 0; channel < 3; channel++) {
            int difference = abs(ours->rgb[3 * i + channel] - theirs.rgb[3 * i + channel]);
            largest = difference > largest ? difference : largest;
        }
        result->differing += largest > 0;
        result->far_off += largest > 1;
    }
    image_free(&theirs);
    return true;
}

/* --- Ours --- */

/* Builds the scene's tree again and again, for the median, and holds the last. */
static OpenclScene *hold_repeatedly(BenchTrace *result, const Scene *scene, const BenchPlan *plan, Error *error)
{
    OpenclScene *held = NULL;
    double builds[BENCH_MAX_REPEATS];
    for (int i = 0; i < plan->repeats; i++) {
        opencl_release(held);
        held = opencl_hold(scene, &plan->settings, error);
        if (!held)
            return NULL;
        builds[i] = opencl_held_report(held)->build_ms;
    }
    result->build_ms = bench_median(builds, plan->repeats);
    return held;
}

/* Both in turn. Each side holds its scene, ready to be traced, as long as this lasts. */
static bool trace_in_turns(BenchTrace *result, OpenclScene *held, const BenchPlan *plan, Process *peer, Image *picture,
                           Error *error)
{
    int repeats = plan->repeats;
    double ours[BENCH_MAX_REPEATS], theirs[BENCH_MAX_REPEATS];
    for (int i = -1; i < repeats; i++) { /* -1: to warm up */
        int at = i < 0 ? 0 : i;
        if (!bench_trace_once(held, picture, &result->report, error) ||
            (peer->pid && !peer_trace(peer, &theirs[at], error)))
            return false;
        ours[at] = result->report.trace_ms;
    }
    result->trace_ms = bench_median(ours, repeats);
    result->fastest_ms = ours[0];
    result->slowest_ms = ours[repeats - 1];
    if (peer->pid)
        result->peer_trace_ms = bench_median(theirs, repeats);
    return true;
}

static bool trace_median(const Scene *scene, const BenchPlan *plan, double *ms, uint64_t *shadow, Error *error)
{
    double times[BENCH_MAX_REPEATS];
    OpenclScene *held = opencl_hold(scene, &plan->settings, error);
    bool ok = held != NULL;
    for (int i = -1; i < plan->repeats && ok; i++) { /* -1: to warm up */
        RenderReport report;
        ok = bench_trace_once(held, NULL, &report, error);
        times[i < 0 ? 0 : i] = report.trace_ms;
        *shadow = report.rays.shadow;
    }
    opencl_release(held);
    *ms = ok ? bench_median(times, plan->repeats) : 0;
    return ok;
}

/* The time of a kind of ray is the time that the picture takes longer with it. */
static bool trace_by_kind(BenchTrace *result, const Scene *scene, const BenchPlan *plan, Error *error)
{
    uint64_t none;
    Scene part = *scene;
    part.shading.max_bounces = 0;
    result->unmirrored_ms = result->trace_ms;
    result->unmirrored_shadow = result->report.rays.shadow;
    if (result->report.rays.reflection > 0 &&
        !trace_median(&part, plan, &result->unmirrored_ms, &result->unmirrored_shadow, error))
        return false;
    part.light_count = 0;
    return trace_median(&part, plan, &result->primary_ms, &none, error);
}

static void settle_screen(BenchScene *wanted, Scene *scene)
{
    if (wanted->columns > 0) {
        scene->screen.columns = wanted->columns;
        scene->screen.rows = wanted->rows;
    }
    if (wanted->grid > 0)
        scene->grid = wanted->grid;
    else if (scene->adaptive)
        scene->grid = 1; /* the peers know grids only */
    scene->adaptive = false;
    wanted->columns = scene->screen.columns;
    wanted->rows = scene->screen.rows;
    wanted->grid = scene->grid;
}

bool bench_settle(BenchScene *wanted, const BenchPlan *plan, Error *error)
{
    Scene scene;
    if (!scene_load(&scene, wanted->path, error))
        return false;
    settle_screen(wanted, &scene);
    bench_tell(&scene, plan);
    scene_free(&scene);
    return true;
}

bool bench_trace(BenchTrace *result, const BenchScene *wanted, const BenchPlan *plan, Error *error)
{
    Scene scene;
    Process peer = {0};
    *result = (BenchTrace){.scene = *wanted};
    if (!scene_load(&scene, wanted->path, error))
        return false;
    settle_screen(&result->scene, &scene);
    result->faces = scene.face_count;
    result->lights = scene.light_count;
    Image picture = {scene.screen.columns, scene.screen.rows, NULL};
    picture.rgb = calloc((size_t)picture.columns * (size_t)picture.rows, 3);
    if (!picture.rgb) {
        scene_free(&scene);
        return error_memory(error, "the picture");
    }
    OpenclScene *held = hold_repeatedly(result, &scene, plan, error);
    bool done =
        held && peer_start(&peer, result, plan, error) && trace_in_turns(result, held, plan, &peer, &picture, error);
    opencl_release(held);
    done = done && (!result->has_peer || peer_finish(&peer, result, plan, &picture, error)) &&
           trace_by_kind(result, &scene, plan, error) &&
           (!plan->skips || bench_skips(result->skips, &result->report, &scene, plan, error));
    process_end(&peer);
    image_free(&picture);
    scene_free(&scene);
    return done;
}
