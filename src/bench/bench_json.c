/* The measurements for programs. Every cJSON function passes a NULL on, so memory is checked once, at the end. */
#include "bench/bench_json.h"

#include "bench/bench_machine.h"
#include "trace/skip.h"

#include <cjson/cJSON.h>
#include <stdlib.h>
#include <unistd.h>

static void add_rays(cJSON *object, const RayCounts *rays)
{
    cJSON *counts = cJSON_AddObjectToObject(object, "rays");
    cJSON_AddNumberToObject(counts, "primary", (double)rays->primary);
    cJSON_AddNumberToObject(counts, "shadow", (double)rays->shadow);
    cJSON_AddNumberToObject(counts, "reflection", (double)rays->reflection);
}

static cJSON *scene_json(const BenchScene *scene)
{
    cJSON *object = cJSON_CreateObject();
    cJSON_AddStringToObject(object, "scene", scene->name);
    cJSON_AddNumberToObject(object, "columns", scene->columns);
    cJSON_AddNumberToObject(object, "rows", scene->rows);
    cJSON_AddNumberToObject(object, "grid", scene->grid);
    return object;
}

static void add_peer(cJSON *object, const BenchTrace *t)
{
    if (!t->has_peer) {
        cJSON_AddNullToObject(object, "peer");
        return;
    }
    cJSON *peer = cJSON_AddObjectToObject(object, "peer");
    cJSON_AddStringToObject(peer, "name", t->peer);
    cJSON_AddNumberToObject(peer, "trace_ms", t->peer_trace_ms);
    cJSON_AddNumberToObject(peer, "build_ms", t->peer_build_ms);
    cJSON_AddNumberToObject(peer, "build_bytes", t->peer_bytes);
    cJSON_AddNumberToObject(peer, "share_inside_embree", t->peer_share);
    cJSON_AddStringToObject(peer, "primary", t->peer_modes[0]);
    cJSON_AddStringToObject(peer, "shadow", t->peer_modes[1]);
    cJSON_AddStringToObject(peer, "reflection", t->peer_modes[2]);
    add_rays(peer, &t->peer_rays);
    cJSON_AddNumberToObject(peer, "differing_pixels", (double)t->differing);
    cJSON_AddNumberToObject(peer, "pixels_off_by_more_than_1", (double)t->far_off);
    cJSON_AddNumberToObject(object, "ratio", t->peer_trace_ms / t->trace_ms);
}

static void add_skips(cJSON *object, const BenchTrace *t)
{
    cJSON *skips = cJSON_AddObjectToObject(object, "skipped");
    for (int skip = 0; skip < SKIP_KINDS; skip++) {
        const BenchSkip *s = &t->skips[skip];
        if (s->count == 0)
            continue;
        cJSON *kind = cJSON_AddObjectToObject(skips, skip_texts[skip].name);
        cJSON_AddNumberToObject(kind, "count", (double)s->count);
        cJSON_AddNumberToObject(kind, "left_out_ms", s->left_ms);
        cJSON_AddNumberToObject(kind, "done_ms", s->done_ms);
        cJSON_AddBoolToObject(kind, "same_picture", s->same);
    }
}

static cJSON *trace_json(const BenchTrace *t)
{
    cJSON *object = scene_json(&t->scene);
    cJSON_AddNumberToObject(object, "faces", t->faces);
    cJSON_AddNumberToObject(object, "lights", t->lights);
    cJSON_AddNumberToObject(object, "trace_ms", t->trace_ms);
    cJSON_AddNumberToObject(object, "fastest_ms", t->fastest_ms);
    cJSON_AddNumberToObject(object, "slowest_ms", t->slowest_ms);
    cJSON_AddNumberToObject(object, "primary_ms", t->primary_ms);
    cJSON_AddNumberToObject(object, "unmirrored_ms", t->unmirrored_ms);
    cJSON_AddNumberToObject(object, "build_ms", t->build_ms);
    cJSON_AddNumberToObject(object, "device_bytes", (double)t->report.device_bytes);
    cJSON_AddStringToObject(object, "build_options", t->report.build_options);
    add_rays(object, &t->report.rays);
    add_skips(object, t);
    add_peer(object, t);
    return object;
}

static void add_phases(cJSON *object, const char *name, const BenchPhases *phases, double wall_ms)
{
    const struct {
        const char *name;
        double ms;
    } fields[] = {{"parse", phases->parse},       {"build", phases->build},
                  {"device", phases->device},     {"compile", phases->compile},
                  {"upload", phases->upload},     {"trace", phases->trace},
                  {"readback", phases->readback}, {"encode", phases->encode},
                  {"total", phases->total},       {"wall", wall_ms}};
    cJSON *list = cJSON_AddObjectToObject(object, name);
    for (size_t i = 0; i < sizeof fields / sizeof *fields; i++)
        cJSON_AddNumberToObject(list, fields[i].name, fields[i].ms);
}

static cJSON *process_json(const BenchProcess *p)
{
    cJSON *object = scene_json(&p->scene);
    cJSON_AddNumberToObject(object, "faces", p->faces);
    if (p->cold_wall_ms > 0)
        add_phases(object, "cold_ms", &p->cold, p->cold_wall_ms);
    add_phases(object, "warm_ms", &p->warm, p->warm_wall_ms);
    cJSON_AddNumberToObject(object, "peak_memory_bytes", p->peak_bytes);
    if (p->povray_wall_ms > 0)
        cJSON_AddNumberToObject(object, "povray_ms", p->povray_wall_ms);
    else
        cJSON_AddNullToObject(object, "povray_ms");
    return object;
}

bool bench_print_json(FILE *out, const Bench *bench, Error *error)
{
    char processor[128];
    cJSON *object = cJSON_CreateObject();
    cJSON_AddStringToObject(object, "processor", bench_processor(processor, sizeof processor));
    cJSON_AddNumberToObject(object, "cores", (double)sysconf(_SC_NPROCESSORS_ONLN));
    cJSON_AddNumberToObject(object, "load", bench->load);
    cJSON_AddNumberToObject(object, "repeats", bench->plan.repeats);
    cJSON *scenes = cJSON_AddArrayToObject(object, "scenes"), *scaling = cJSON_AddArrayToObject(object, "scaling"),
          *processes = cJSON_AddArrayToObject(object, "processes"), *curve = cJSON_AddArrayToObject(object, "curve");
    bool whole = scenes && scaling && processes && curve;
    for (int i = 0; i < bench->trace_count; i++)
        whole = cJSON_AddItemToArray(scenes, trace_json(&bench->traces[i])) && whole;
    for (int i = 0; i < bench->scaling_count; i++)
        whole = cJSON_AddItemToArray(scaling, trace_json(&bench->scaling[i])) && whole;
    for (int i = 0; i < bench->process_count; i++)
        whole = cJSON_AddItemToArray(processes, process_json(&bench->processes[i])) && whole;
    for (int i = 0; i < bench->curve_count; i++)
        whole = cJSON_AddItemToArray(curve, process_json(&bench->curve[i])) && whole;
    char *text = whole ? cJSON_PrintUnformatted(object) : NULL;
    if (text)
        fprintf(out, "%s\n", text);
    cJSON_free(text);
    cJSON_Delete(object);
    return text ? true : error_memory(error, "the measurements");
}
