/* rectray bench error: for each choice that the renderer offers, its time and its distance from the truth. */
#include "bench/bench_arithmetic_report.h"
#include "bench/bench_document.h"
#include "bench/bench_error_report.h"
#include "bench/bench_ladder.h"
#include "bench/bench_machine.h"
#include "bench/bench_scene.h"
#include "command/command.h"

#include <stdlib.h>

#define MARK_BEGIN "<!-- bench error: made by `make bench-error`, from here -->\n"
#define MARK_END "<!-- bench error: to here -->\n"

static bool measure_scene(BenchErrors *errors, BenchScene scene, bool only_arithmetic, const Options *options,
                          Error *error)
{
    BenchError *result = &errors->scenes[errors->count++];
    if (!options->quiet)
        fprintf(stderr, "measuring %s\n", scene.name);
    scene.columns = options->columns;
    scene.rows = options->rows;
    scene.grid = options->grid;
    if (only_arithmetic)
        return bench_error_arithmetic_only(result, &scene, &errors->plan, error);
    return bench_error(result, &scene, &errors->plan, error) &&
           (!options->folder || bench_error_write_csv(result, &errors->plan.folder, error));
}

static bool measure_rungs(BenchErrors *errors, const BenchRung *rungs, bool only_arithmetic, const Options *options,
                          Error *error)
{
    for (const BenchRung *rung = rungs; rung->name; rung++) {
        BenchScene scene;
        if (rung->small && !(bench_rung(rung, &errors->plan.folder, &scene, error) &&
                             measure_scene(errors, scene, only_arithmetic, options, error)))
            return false;
    }
    return true;
}

static bool measure(BenchErrors *errors, const Options *options, Error *error)
{
    if (options->ladder)
        return measure_rungs(errors, bench_ladder, false, options, error) &&
               measure_rungs(errors, bench_lessons, true, options, error);
    for (int i = 1; i < options->operand_count; i++) {
        BenchScene scene;
        if (!bench_scene_of(options->operands[i], &scene, error) ||
            !measure_scene(errors, scene, false, options, error))
            return false;
    }
    return true;
}

static bool measure_and_report(BenchErrors *errors, const Options *options, Error *error)
{
    BenchDocument document;
    errors->load = bench_load();
    bool done =
        bench_document_read(&document, options->output, MARK_BEGIN, MARK_END, error) && measure(errors, options, error);
    if (done && document.text)
        done = bench_document_write(&document, bench_error_print_markdown, errors, error);
    else if (done)
        bench_error_print_markdown(stdout, errors);
    if (done && options->folder)
        done = bench_arithmetic_write_csv(errors, &errors->plan.folder, error);
    bench_document_free(&document);
    return done;
}

static bool check_options(const Options *options, Error *error)
{
    if (options->operand_count < 2 && !options->ladder)
        return error_set(error, ERROR_USAGE,
                         "bench error needs scenes to measure, such as `rectray bench error scenes/cornell.json`; or "
                         "--ladder, for the small ones of the documentation");
    const struct {
        bool given;
        const char *name, *why;
    } refused[] = {
        {options->json, "json", "with --folder it writes CSV"},
        {options->precision_given, "precision", "it measures both"},
        {options->settings.kernel != KERNEL_AUTO, "kernel", "it measures both"},
        {options->settings.arithmetic != ARITHMETIC_EXACT, "arithmetic", "it measures both"},
    };
    for (size_t i = 0; i < sizeof refused / sizeof *refused; i++)
        if (refused[i].given)
            return error_set(error, ERROR_USAGE, "bench error takes no --%s: %s", refused[i].name, refused[i].why);
    return true;
}

bool command_bench_error(const Options *options, Error *error)
{
    if (!check_options(options, error))
        return false;
    BenchErrors *errors = calloc(1, sizeof *errors);
    if (!errors)
        return error_memory(error, "the measurements");
    errors->plan = (BenchPlan){.settings = options->settings,
                               .repeats = options->repeats > 0 ? options->repeats : 5,
                               .tells = !options->quiet};
    bool done = bench_folder_open(&errors->plan.folder, options->folder, error);
    if (done) {
        done = measure_and_report(errors, options, error);
        bench_folder_close(&errors->plan.folder);
    }
    free(errors);
    return done;
}
