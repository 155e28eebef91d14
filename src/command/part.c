#include "command/part.h"

#include "command/usage.h"
#include "opencl/opencl_sources.h"
#include "scene/scene_hash.h"

#include <stdio.h>
#include <stdlib.h>

/* The largest block that a kernel renders at once has so many rows. A block that is cut would be traced twice. */
enum { BLOCK_ROWS = 32 };

PartRange part_range(OptionPart part, int count)
{
    int first = (int)((long long)count * (part.number - 1) / part.count);
    int end = (int)((long long)count * part.number / part.count);
    return (PartRange){first, end - first};
}

bool part_check(const Options *options, int count, const char *things, Error *error)
{
    const struct {
        bool given;
        const char *name, *cure;
    } others[] = {
        {options->settings.region.columns > 0, "--region", "a part is a band of the whole picture"},
        {options->mark_given, "--mark", "join the parts first"},
        {options->map_count > 0, "--map", "draw the map in a run without --part"},
        {options->watch, "--watch", "it renders one picture again and again"},
    };
    for (size_t i = 0; i < sizeof others / sizeof *others; i++)
        if (others[i].given)
            return error_set(error, ERROR_USAGE, "%s does not go with --part: %s", others[i].name, others[i].cure);
    return options->part.count <= count ||
           error_set(error, ERROR_USAGE, "--part %d/%d: more parts than %s, of which there are %d",
                     options->part.number, options->part.count, things, count);
}

PartRange part_rows(OptionPart part, int rows)
{
    int blocks = (rows + BLOCK_ROWS - 1) / BLOCK_ROWS;
    if (blocks < part.count)
        return part_range(part, rows);
    PartRange range = part_range(part, blocks);
    int first = range.first * BLOCK_ROWS, end = (range.first + range.count) * BLOCK_ROWS;
    return (PartRange){first, (end < rows ? end : rows) - first};
}

Region part_region(OptionPart part, const Scene *scene)
{
    PartRange range = part_rows(part, scene->screen.rows);
    return (Region){0, range.first, scene->screen.columns, range.count};
}

/* Continues a hash with the texts of all kernels. Which of them renders the picture, device, lanes and tree decide, on
 * which no pixel depends. A missing text counts as empty: where it is needed, the build fails. */
static uint64_t hash_kernels(uint64_t hash, Arithmetic arithmetic)
{
    static const char *const roots[] = {"tile/render.cl", "packet/render.cl", "adaptive/refine.cl",    "gpu.cl",
                                        "gpu_exact.cl",   "gpu_adaptive.cl",  "gpu_adaptive_exact.cl", "gpu_judge.cl",
                                        "plain.cl",       "pairs.cl"},
                             *const trees[] = {"all_faces", "bvh", "kdtree"};
    for (size_t root = 0; root < sizeof roots / sizeof *roots; root++) {
        for (size_t tree = 0; tree < sizeof trees / sizeof *trees; tree++) {
            Error missing = {.kind = ERROR_NONE};
            char *text = opencl_sources(roots[root], trees[tree], render_arithmetics[arithmetic], &missing);
            hash = scene_hash_text(hash, text ? text : "");
            free(text);
        }
    }
    return hash;
}

PartNote part_note(const Options *options, const Scene *scene, Precision precision)
{
    const RenderSettings *settings = &options->settings;
    const Region region = part_region(options->part, scene);
    bool textbook = settings->arithmetic == ARITHMETIC_TEXTBOOK, opencl = options->backend == BACKEND_OPENCL;
    char shift[32];
    snprintf(shift, sizeof shift, "%.9g", textbook ? (double)settings->shift : 0.0);
    const char *const words[] = {RECTRAY_VERSION,
                                 render_backends[options->backend],
                                 render_precisions[precision],
                                 opencl ? render_kernels[settings->kernel] : "",
                                 render_arithmetics[settings->arithmetic],
                                 shift};
    uint64_t hash = HASH_START;
    for (size_t i = 0; i < sizeof words / sizeof *words; i++)
        hash = scene_hash_text(hash, words[i]);
    if (opencl)
        hash = hash_kernels(hash, settings->arithmetic);
    return (PartNote){.number = options->part.number,
                      .count = options->part.count,
                      .first_row = region.row,
                      .picture_rows = scene->screen.rows,
                      .hash = scene_hash_all(hash, scene)};
}
