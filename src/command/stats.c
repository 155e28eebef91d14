/* The same numbers twice: a table for people, JSON for programs. To add one, add a line to its list here and to
 * docs/commands.md; what has no list of its own goes into both functions. */
#include "command/stats.h"

#include "trace/skip.h"

#include <cjson/cJSON.h>
#include <inttypes.h>
#include <stdlib.h>
#include <sys/resource.h>

typedef struct Phase {
    const char *name;
    double ms;
} Phase;

typedef struct Count {
    const char *group, *name, *words; /* the keys in the JSON; what the table says */
    uint64_t count;
} Count;

enum { PHASES = 9, COUNTS = 6 + SKIP_KINDS };

typedef struct Lists {
    Phase phases[PHASES];
    Count counts[COUNTS];
} Lists;

static Lists lists_of(const Stats *stats)
{
    const RenderReport *report = &stats->report;
    Lists lists = {
        .phases = {{"parse", stats->parse_ms},
                   {"build", report->build_ms},
                   {"device", report->device_ms},
                   {"compile", report->compile_ms},
                   {"upload", report->upload_ms},
                   {"trace", report->trace_ms},
                   {"readback", report->readback_ms},
                   {"encode", stats->encode_ms},
                   {"total", stats->total_ms}},
        .counts = {{"rays", "primary", "primary rays", report->rays.primary},
                   {"rays", "shadow", "shadow rays", report->rays.shadow},
                   {"rays", "reflection", "reflected rays", report->rays.reflection},
                   {"pixels", "refined", "refined pixels", report->refined_pixels},
                   {"tests", "box", "box tests", report->box_tests},
                   {"tests", "face", "face tests", report->face_tests}},
    };
    for (int skip = 0; skip < SKIP_KINDS; skip++)
        lists.counts[COUNTS - SKIP_KINDS + skip] =
            (Count){"skipped", skip_texts[skip].name, skip_texts[skip].words, report->skipped[skip]};
    return lists;
}

void stats_add(Stats *sum, const Stats *other)
{
    const RenderReport *a = &sum->report, *b = &other->report;
    Stats both = *other;
    RenderReport *report = &both.report;
    both.parse_ms += sum->parse_ms;
    both.encode_ms += sum->encode_ms;
    both.total_ms += sum->total_ms;
    report->build_ms = a->build_ms + b->build_ms;
    report->upload_ms = a->upload_ms + b->upload_ms;
    report->device_ms = a->device_ms + b->device_ms;
    report->compile_ms = a->compile_ms + b->compile_ms;
    report->trace_ms = a->trace_ms + b->trace_ms;
    report->readback_ms = a->readback_ms + b->readback_ms;
    report->rays.primary = a->rays.primary + b->rays.primary;
    report->rays.shadow = a->rays.shadow + b->rays.shadow;
    report->rays.reflection = a->rays.reflection + b->rays.reflection;
    report->box_tests = a->box_tests + b->box_tests;
    report->face_tests = a->face_tests + b->face_tests;
    report->refined_pixels = a->refined_pixels + b->refined_pixels;
    report->exact_pixels = a->exact_pixels + b->exact_pixels;
    for (int skip = 0; skip < SKIP_KINDS; skip++)
        report->skipped[skip] = a->skipped[skip] + b->skipped[skip];
    *sum = both;
}

Stats stats_begin(const Scene *scene, Backend backend, Precision precision)
{
    return (Stats){
        .faces = scene->face_count,
        .lights = scene->light_count,
        .backend = backend,
        .precision = backend == BACKEND_REFERENCE ? PRECISION_DOUBLE : precision,
    };
}

/* The most memory that the program has held so far; getrusage counts in KiB on Linux, in bytes on macOS. */
static uint64_t peak_memory_bytes(void)
{
    struct rusage usage;
    getrusage(RUSAGE_SELF, &usage);
#ifdef __APPLE__
    return (uint64_t)usage.ru_maxrss;
#else
    return (uint64_t)usage.ru_maxrss * 1024;
#endif
}

/* The kernel is told where it is not the one for processors. */
static bool tells_kernel(const RenderReport *report)
{
    return report->kernel == KERNEL_PLAIN || report->kernel == KERNEL_GPU;
}

static void print_text(FILE *out, const Stats *stats)
{
    Lists lists = lists_of(stats);
    const RenderReport *report = &stats->report;
    for (int i = 0; i < PHASES; i++)
        fprintf(out, "%-22s%14.3f ms\n", lists.phases[i].name, lists.phases[i].ms);
    for (int i = 0; i < COUNTS; i++)
        fprintf(out, "%-22s%14" PRIu64 "\n", lists.counts[i].words, lists.counts[i].count);
    fprintf(out, "%-22s%14d\n", "faces", stats->faces);
    fprintf(out, "%-22s%14d\n", "lights", stats->lights);
    fprintf(out, "%-22s%14.1f MiB\n", "device memory", (double)report->device_bytes / 1048576);
    fprintf(out, "%-22s%14.1f MiB\n", "peak memory", (double)peak_memory_bytes() / 1048576);
    fprintf(out, "%-22s%s, %s, %d rays at once, accel %s\n", "backend", render_backends[stats->backend],
            render_precisions[stats->precision], report->lanes, render_accels[report->accel]);
    fprintf(out, "%-22s%s\n", "device", report->device);
    fprintf(out, "%-22s%s\n", "build options", report->build_options);
    if (report->kernel == KERNEL_GPU)
        fprintf(out, "%-22s%14" PRIu64 "\n", "pixels done exactly", report->exact_pixels);
    if (tells_kernel(report))
        fprintf(out, "%-22s%s, %s arithmetic\n", "kernel", render_kernels[report->kernel],
                render_arithmetics[stats->arithmetic]);
}

/* A whole number with all its digits, which a double may not hold. */
static cJSON *add_count(cJSON *object, const char *name, uint64_t count)
{
    char digits[24];
    snprintf(digits, sizeof digits, "%" PRIu64, count);
    return cJSON_AddRawToObject(object, name, digits);
}

/* The object's member, made where it is not there yet. */
static cJSON *group_of(cJSON *object, const char *name)
{
    cJSON *group = cJSON_GetObjectItem(object, name);
    return group ? group : cJSON_AddObjectToObject(object, name);
}

/* Every cJSON function passes a NULL on, and cJSON_Add... returns NULL without memory. */
static bool fill_json(cJSON *object, const Stats *stats)
{
    Lists lists = lists_of(stats);
    const RenderReport *report = &stats->report;
    bool ok = true;
    for (int i = 0; i < PHASES; i++)
        ok = cJSON_AddNumberToObject(group_of(object, "phases_ms"), lists.phases[i].name, lists.phases[i].ms) && ok;
    for (int i = 0; i < COUNTS; i++)
        ok = add_count(group_of(object, lists.counts[i].group), lists.counts[i].name, lists.counts[i].count) && ok;
    return ok && cJSON_AddNumberToObject(object, "faces", stats->faces) &&
           cJSON_AddNumberToObject(object, "lights", stats->lights) &&
           cJSON_AddStringToObject(object, "device", report->device) &&
           cJSON_AddStringToObject(object, "backend", render_backends[stats->backend]) &&
           cJSON_AddStringToObject(object, "precision", render_precisions[stats->precision]) &&
           cJSON_AddNumberToObject(object, "lanes", report->lanes) &&
           cJSON_AddStringToObject(object, "accel", render_accels[report->accel]) &&
           cJSON_AddStringToObject(object, "build_options", report->build_options) &&
           add_count(object, "device_memory_bytes", report->device_bytes) &&
           add_count(object, "peak_memory_bytes", peak_memory_bytes()) &&
           (!tells_kernel(report) ||
            (cJSON_AddStringToObject(object, "kernel", render_kernels[report->kernel]) &&
             cJSON_AddStringToObject(object, "arithmetic", render_arithmetics[stats->arithmetic]))) &&
           (report->kernel != KERNEL_GPU || add_count(object, "exact_pixels", report->exact_pixels));
}

static bool print_json(FILE *out, const Stats *stats, Error *error)
{
    cJSON *object = cJSON_CreateObject();
    char *text = fill_json(object, stats) ? cJSON_PrintUnformatted(object) : NULL;
    if (text)
        fprintf(out, "%s\n", text);
    cJSON_free(text);
    cJSON_Delete(object);
    return text ? true : error_memory(error, "the statistics");
}

bool stats_print(FILE *out, StatsFormat format, const Stats *stats, Error *error)
{
    if (format == STATS_JSON)
        return print_json(out, stats, error);
    if (format == STATS_TEXT)
        print_text(out, stats);
    return true;
}
