/* rectray bench kernels: one scene through all kernels, from the reference to packets in classified tiles. */
#include "bench/bench_document.h"
#include "bench/bench_kernels_report.h"
#include "bench/bench_machine.h"
#include "bench/bench_scene.h"
#include "command/command.h"

#include <stdlib.h>

#define MARK_BEGIN "<!-- bench kernels: made by `make bench-kernels`, from here -->\n"
#define MARK_END "<!-- bench kernels: to here -->\n"

static bool measure_scene(BenchKernelScenes *kernels, const char *path, const Options *options, Error *error)
{
    BenchKernels *result = &kernels->scenes[kernels->count++];
    BenchScene scene;
    if (!bench_scene_of(path, &scene, error))
        return false;
    if (!options->quiet)
        fprintf(stderr, "measuring %s\n", scene.name);
    scene.columns = options->columns;
    scene.rows = options->rows;
    scene.grid = options->grid;
    return bench_kernels(result, &scene, &kernels->plan, error) &&
           (!options->folder || bench_kernels_write_tsv(result, &kernels->plan.folder, error));
}

static bool measure(BenchKernelScenes *kernels, const Options *options, Error *error)
{
    for (int i = 1; i < options->operand_count; i++)
        if (!measure_scene(kernels, options->operands[i], options, error))
            return false;
    return true;
}

static bool measure_and_report(BenchKernelScenes *kernels, const Options *options, Error *error)
{
    BenchDocument document;
    kernels->load = bench_load();
    bool done = bench_document_read(&document, options->output, MARK_BEGIN, MARK_END, error) &&
                measure(kernels, options, error);
    if (done && document.text)
        done = bench_document_write(&document, bench_kernels_print_markdown, kernels, error);
    else if (done)
        bench_kernels_print_markdown(stdout, kernels);
    bench_document_free(&document);
    return done;
}

static bool check_options(const Options *options, Error *error)
{
    const RenderSettings *settings = &options->settings;
    if (options->operand_count < 2)
        return error_set(error, ERROR_USAGE,
                         "bench kernels needs scenes to measure, such as `rectray bench kernels scenes/gallery.json`");
    const struct {
        bool given;
        const char *name, *why;
    } refused[] = {
        {options->ladder, "ladder", "name the scenes"},
        {options->json, "json", "with --folder it writes columns with tabs between them"},
        {settings->kernel != KERNEL_AUTO, "kernel", "it measures both"},
        {settings->arithmetic != ARITHMETIC_EXACT, "arithmetic", "packets have the exact one only"},
        {settings->accel != ACCEL_AUTO, "accel", "it measures all"},
        {settings->lanes != 0, "lanes", "it measures all"},
    };
    for (size_t i = 0; i < sizeof refused / sizeof *refused; i++)
        if (refused[i].given)
            return error_set(error, ERROR_USAGE, "bench kernels takes no --%s: %s", refused[i].name, refused[i].why);
    return true;
}

bool command_bench_kernels(const Options *options, Error *error)
{
    if (!check_options(options, error))
        return false;
    BenchKernelScenes *kernels = calloc(1, sizeof *kernels);
    if (!kernels)
        return error_memory(error, "the measurements");
    kernels->plan = (BenchPlan){.settings = options->settings,
                                .repeats = options->repeats > 0 ? options->repeats : 5,
                                .tells = !options->quiet};
    bool done = bench_folder_open(&kernels->plan.folder, options->folder, error);
    if (done) {
        done = measure_and_report(kernels, options, error);
        bench_folder_close(&kernels->plan.folder);
    }
    free(kernels);
    return done;
}
