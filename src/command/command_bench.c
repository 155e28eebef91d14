/* rectray bench: measures scenes, or the ladder of scenes on which every figure of docs/performance.md stands.
 * `bench error` is command_bench_error.c, `bench kernels` is command_bench_kernels.c. */
#include "base/text.h"
#include "bench/bench_document.h"
#include "bench/bench_json.h"
#include "bench/bench_ladder.h"
#include "bench/bench_machine.h"
#include "bench/bench_report.h"
#include "command/command.h"

#include <stdlib.h>
#include <string.h>

#define MARK_BEGIN "<!-- bench: made by `make bench-peers`, from here -->\n"
#define MARK_END "<!-- bench: to here -->\n"

/* Boxes: some 10 to 1 000 000 faces in steps of about the square root of ten. */
static const int cities[] = {1, 5, 16, 50, 166, 500, 1666, 5000, 16666, 50000, 166666};

/* Whole processes of some 10 to 10 000 000 faces, in steps of ten. */
static const int process_cities[] = {1, 16, 166, 1666, 16666, 166666, 1666666};

/* Whole processes are measured on these rungs. */
static const struct {
    const char *rung;
    int columns, rows;
} process_rungs[] = {
    {"cornell", 640, 480},   {"original", 1920, 1080}, {"cornell", 1920, 1080},   {"mirrors", 1920, 1080},
    {"gallery", 1920, 1080}, {"city-1k", 1920, 1080},  {"city-200k", 1920, 1080},
};

/* --- Measuring --- */

static void announce(const Options *options, const char *what, const char *name)
{
    if (!options->quiet)
        fprintf(stderr, "%s %s\n", what, name);
}

static void override_screen(BenchScene *scene, const Options *options)
{
    if (options->columns > 0) {
        scene->columns = options->columns;
        scene->rows = options->rows;
    }
    if (options->grid > 0)
        scene->grid = options->grid;
}

/* A rung in the size of docs/performance.md, unless the options say otherwise. */
static bool rung_scene(const BenchRung *rung, const Bench *bench, const Options *options, BenchScene *scene,
                       Error *error)
{
    if (!bench_rung(rung, &bench->plan.folder, scene, error))
        return false;
    scene->columns = 1920;
    scene->rows = 1080;
    scene->grid = 1;
    override_screen(scene, options);
    return true;
}

static bool measure_ladder(Bench *bench, const Options *options, Error *error)
{
    for (const BenchRung *rung = bench_ladder; rung->name; rung++) {
        BenchScene scene;
        announce(options, "tracing", rung->name);
        if (!rung_scene(rung, bench, options, &scene, error) ||
            !bench_trace(&bench->traces[bench->trace_count], &scene, &bench->plan, error))
            return false;
        bench->trace_count++;
    }
    return true;
}

static bool measure_scaling(Bench *bench, const Options *options, Error *error)
{
    bench->plan.skips = false;
    for (size_t i = 0; i < sizeof cities / sizeof *cities; i++) {
        char name[32];
        snprintf(name, sizeof name, "city-%d", cities[i]);
        BenchScene scene;
        announce(options, "tracing", name);
        BenchRung rung = {.name = name, .kind = "city", .size = cities[i]};
        if (!rung_scene(&rung, bench, options, &scene, error) ||
            !bench_trace(&bench->scaling[bench->scaling_count], &scene, &bench->plan, error))
            return false;
        bench->scaling_count++;
    }
    return true;
}

static bool measure_processes(Bench *bench, const Options *options, Error *error)
{
    for (size_t i = 0; i < sizeof process_rungs / sizeof *process_rungs; i++) {
        const BenchRung *rung = bench_rung_named(process_rungs[i].rung);
        BenchProcess *result = &bench->processes[bench->process_count++];
        BenchScene scene;
        announce(options, "rendering", rung->name);
        if (!rung_scene(rung, bench, options, &scene, error))
            return false;
        scene.columns = process_rungs[i].columns;
        scene.rows = process_rungs[i].rows;
        override_screen(&scene, options);
        if (!bench_process(result, &scene, &bench->plan, error) || !bench_povray(result, &bench->plan, error))
            return false;
    }
    return true;
}

/* Of many faces few runs are enough: they take seconds. */
static bool measure_curve(Bench *bench, const Options *options, Error *error)
{
    BenchPlan plan = bench->plan;
    for (size_t i = 0; i < sizeof process_cities / sizeof *process_cities; i++) {
        char name[32];
        snprintf(name, sizeof name, "city-%d", process_cities[i]);
        BenchScene scene;
        announce(options, "rendering", name);
        BenchRung rung = {.name = name, .kind = "city", .size = process_cities[i]};
        plan.repeats = process_cities[i] > 100000 && plan.repeats > 3 ? 3 : plan.repeats;
        if (!rung_scene(&rung, bench, options, &scene, error) ||
            !bench_process_warm(&bench->curve[bench->curve_count], &scene, &plan, error))
            return false;
        bench->curve_count++;
    }
    return true;
}

static bool named_scene(const Options *options, int index, const BenchPlan *plan, BenchScene *scene, Error *error)
{
    const char *path = options->operands[index], *slash = strrchr(path, '/');
    *scene = (BenchScene){.columns = 0};
    if (strlen(path) >= sizeof scene->path)
        return error_set(error, ERROR_USAGE, "the path is too long: %s", path);
    snprintf(scene->name, sizeof scene->name, "%.*s", BENCH_NAME - 1, slash ? slash + 1 : path);
    text_make_utf8(scene->name);
    snprintf(scene->path, sizeof scene->path, "%s", path);
    override_screen(scene, options);
    return bench_settle(scene, plan, error);
}

static bool measure_scenes(Bench *bench, const Options *options, Error *error)
{
    BenchScene scenes[BENCH_MAX_SCENES];
    for (int i = 0; i < options->operand_count; i++, bench->process_count++) {
        announce(options, "rendering", options->operands[i]);
        if (!named_scene(options, i, &bench->plan, &scenes[i], error) ||
            !bench_process(&bench->processes[i], &scenes[i], &bench->plan, error))
            return false;
    }
    for (int i = 0; i < options->operand_count; i++, bench->trace_count++) {
        announce(options, "tracing", options->operands[i]);
        if (!bench_trace(&bench->traces[i], &scenes[i], &bench->plan, error))
            return false;
    }
    return true;
}

/* --- Telling --- */

static bool report(const Bench *bench, const Options *options, const BenchDocument *document, Error *error)
{
    if (options->ladder && options->folder && !bench_write_plot_data(bench, error))
        return false;
    if (document->text && !bench_document_write(document, bench_print_markdown, bench, error))
        return false;
    if (options->json)
        return bench_print_json(stdout, bench, error);
    if (!document->text)
        bench_print_markdown(stdout, bench);
    return true;
}

static bool measure(Bench *bench, const Options *options, Error *error)
{
    if (!options->ladder)
        return measure_scenes(bench, options, error);
    return measure_processes(bench, options, error) && measure_curve(bench, options, error) &&
           measure_ladder(bench, options, error) && measure_scaling(bench, options, error);
}

static bool measure_and_report(Bench *bench, const Options *options, Error *error)
{
    BenchDocument document;
    bench->load = bench_load();
    /* The document first: nobody measures for many minutes to hear that it is not there. */
    bool done = bench_document_read(&document, options->output, MARK_BEGIN, MARK_END, error) &&
                measure(bench, options, error) && report(bench, options, &document, error);
    bench_document_free(&document);
    return done;
}

static bool check_scenes(const Options *options, Error *error)
{
    for (int i = 0; i < options->operand_count; i++)
        if (text_is_stream(options->operands[i]))
            return error_set(error, ERROR_USAGE, "bench reads its scenes more than once; give files, not pipes");
    return true;
}

bool command_bench(const Options *options, Error *error)
{
    bool of_error = options->operand_count > 0 && strcmp(options->operands[0], "error") == 0;
    if (!check_scenes(options, error))
        return false;
    if (of_error) /* it measures both arithmetics, so --shift needs no other option */
        return command_bench_error(options, error);
    if (!options_agree(options, error))
        return false;
    if (options->operand_count > 0 && strcmp(options->operands[0], "kernels") == 0)
        return command_bench_kernels(options, error);
    if (options->operand_count == 0 && !options->ladder)
        return error_set(
            error, ERROR_USAGE,
            "bench needs scenes to measure: `rectray bench SCENE...` for their speed, `rectray bench error "
            "SCENE...` for time against error, `rectray bench kernels SCENE...` for one kernel after another; --ladder "
            "instead of scenes measures those of the documentation");
    Bench *bench = calloc(1, sizeof *bench);
    if (!bench)
        return error_memory(error, "the measurements");
    bench->plan = (BenchPlan){.settings = options->settings,
                              .repeats = options->repeats > 0 ? options->repeats : 5,
                              .skips = true,
                              .tells = !options->quiet};
    bool done = bench_folder_open(&bench->plan.folder, options->folder, error);
    if (done) {
        done = measure_and_report(bench, options, error);
        bench_folder_close(&bench->plan.folder);
    }
    free(bench);
    return done;
}
