/* rectray bench: measures scenes, or the ladder of scenes on which every figure of docs/performance.md stands.
 * To add a rung to the ladder: its line in the table below. */
#include "command.h"
#include "bench_report.h"
#include "output.h"
#include "text.h"

#include <stdlib.h>
#include <string.h>

#define MARK_BEGIN "<!-- bench: made by `make bench-peers`, from here -->\n"
#define MARK_END "<!-- bench: to here -->\n"

enum { DOCUMENT_LIMIT = 16 << 20 };

typedef struct Rung {
    const char *name;
    const char *path; /* NULL: generated */
    const char *kind;
    int size;
} Rung;

static const Rung ladder[] = {
    {"original", "scenes/original.json", NULL, 0},
    {"cornell", "scenes/cornell.json", NULL, 0},
    {"mirrors", "scenes/mirrors.json", NULL, 0},
    {"gallery", "scenes/gallery.json", NULL, 0},
    {"menger-2", NULL, "menger", 2},
    {"menger-3", NULL, "menger", 3},
    {"menger-4", NULL, "menger", 4},
    {"city-1k", NULL, "city", 1000},
    {"city-20k", NULL, "city", 20000},
    {"city-200k", NULL, "city", 200000},
};

/* Boxes: some 10 to 1 000 000 faces in steps of about the square root of ten. */
static const int cities[] = {1, 5, 16, 50, 166, 500, 1666, 5000, 16666, 50000, 166666};

/* Whole processes are measured on these rungs. */
static const struct {
    int rung, columns, rows;
} process_rungs[] = {{1, 640, 480},   {0, 1920, 1080}, {1, 1920, 1080}, {2, 1920, 1080},
                     {3, 1920, 1080}, {7, 1920, 1080}, {9, 1920, 1080}};

/* --- Measuring --- */

static void tell(const Options *options, const char *what, const char *name)
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

static bool rung_scene(const Rung *rung, BenchScene *scene, Error *error)
{
    *scene = (BenchScene){.columns = 1920, .rows = 1080, .grid = 1};
    snprintf(scene->name, sizeof scene->name, "%s", rung->name);
    if (!rung->path)
        return bench_generate(scene, rung->kind, rung->size, error);
    snprintf(scene->path, sizeof scene->path, "%s", rung->path);
    return true;
}

static bool measure_ladder(Bench *bench, const Options *options, Error *error)
{
    for (size_t i = 0; i < sizeof ladder / sizeof *ladder; i++) {
        BenchScene scene;
        tell(options, "tracing", ladder[i].name);
        if (!rung_scene(&ladder[i], &scene, error))
            return false;
        override_screen(&scene, options);
        if (!bench_trace(&bench->traces[bench->trace_count], &scene, &options->settings, bench->repeats, error))
            return false;
        bench->trace_count++;
    }
    return true;
}

static bool measure_scaling(Bench *bench, const Options *options, Error *error)
{
    for (size_t i = 0; i < sizeof cities / sizeof *cities; i++) {
        char name[32];
        snprintf(name, sizeof name, "city-%d", cities[i]);
        BenchScene scene;
        tell(options, "tracing", name);
        if (!rung_scene(&(Rung){name, NULL, "city", cities[i]}, &scene, error))
            return false;
        override_screen(&scene, options);
        if (!bench_trace(&bench->scaling[bench->scaling_count], &scene, &options->settings, bench->repeats, error))
            return false;
        bench->scaling_count++;
    }
    return true;
}

static bool measure_processes(Bench *bench, const Options *options, Error *error)
{
    for (size_t i = 0; i < sizeof process_rungs / sizeof *process_rungs; i++) {
        const Rung *rung = &ladder[process_rungs[i].rung];
        BenchProcess *result = &bench->processes[bench->process_count++];
        BenchScene scene;
        tell(options, "rendering", rung->name);
        if (!rung_scene(rung, &scene, error))
            return false;
        scene.columns = process_rungs[i].columns;
        scene.rows = process_rungs[i].rows;
        override_screen(&scene, options);
        if (!bench_process(result, &scene, bench->repeats, error) ||
            !bench_povray(result, bench->repeats < 3 ? bench->repeats : 3, error))
            return false;
    }
    return true;
}

static bool named_scene(const Options *options, int index, BenchScene *scene, Error *error)
{
    const char *path = options->operands[index], *slash = strrchr(path, '/');
    *scene = (BenchScene){.columns = 0};
    if (strlen(path) >= sizeof scene->path)
        return error_set(error, ERROR_USAGE, "the path is too long: %s", path);
    snprintf(scene->name, sizeof scene->name, "%.*s", BENCH_NAME - 1, slash ? slash + 1 : path);
    text_make_utf8(scene->name);
    snprintf(scene->path, sizeof scene->path, "%s", path);
    override_screen(scene, options);
    return bench_settle(scene, error);
}

static bool measure_scenes(Bench *bench, const Options *options, Error *error)
{
    BenchScene scenes[BENCH_MAX_SCENES];
    for (int i = 0; i < options->operand_count; i++, bench->process_count++) {
        tell(options, "rendering", options->operands[i]);
        if (!named_scene(options, i, &scenes[i], error) ||
            !bench_process(&bench->processes[i], &scenes[i], bench->repeats, error))
            return false;
    }
    for (int i = 0; i < options->operand_count; i++, bench->trace_count++) {
        tell(options, "tracing", options->operands[i]);
        if (!bench_trace(&bench->traces[i], &scenes[i], &options->settings, bench->repeats, error))
            return false;
    }
    return true;
}

/* --- Telling --- */

/* A document, and the place in it where the tables go. */
typedef struct Document {
    char *text; /* NULL: none is wanted */
    char *begin, *end;
} Document;

static bool document_read(Document *document, const char *path, Error *error)
{
    long length;
    document->text = text_read(path, DOCUMENT_LIMIT, &length, error);
    if (!document->text)
        return false;
    document->begin = strstr(document->text, MARK_BEGIN);
    document->end = document->begin ? strstr(document->begin, MARK_END) : NULL;
    return document->end || error_set(error, ERROR_INPUT, "%s: the lines %.*s and %.*s are missing", path,
                                      (int)strlen(MARK_BEGIN) - 1, MARK_BEGIN, (int)strlen(MARK_END) - 1, MARK_END);
}

/* Puts the tables between the marks; all other words stay. */
static bool document_write(const Document *document, const Bench *bench, const char *path, Error *error)
{
    size_t before = (size_t)(document->begin - document->text) + strlen(MARK_BEGIN);
    Output output;
    if (!output_open(&output, path, "the page", error))
        return false;
    fwrite(document->text, 1, before, output.file);
    bench_print_markdown(output.file, bench);
    fputs(document->end, output.file);
    return output_commit(&output, error);
}

static bool report(const Bench *bench, const Options *options, const Document *document, Error *error)
{
    if (options->ladder && !bench_write_plot_data(bench, error))
        return false;
    if (document->text && !document_write(document, bench, options->output, error))
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
    return measure_processes(bench, options, error) && measure_ladder(bench, options, error) &&
           measure_scaling(bench, options, error);
}

bool command_bench(const Options *options, Error *error)
{
    if (options->operand_count == 0 && !options->ladder)
        return error_set(error, ERROR_USAGE, "bench needs scenes, or --ladder");
    Document document = {0};
    Bench *bench = calloc(1, sizeof *bench);
    if (!bench)
        return error_memory(error, "the measurements");
    bench->load = bench_load();
    bench->repeats = options->repeats > 0 ? options->repeats : 5;
    /* The document first: nobody measures for many minutes to hear that it is not there. */
    bool done = (!options->output || document_read(&document, options->output, error)) &&
                measure(bench, options, error) && report(bench, options, &document, error);
    free(document.text);
    free(bench);
    return done;
}
