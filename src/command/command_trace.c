/* rectray trace: the walkthrough of one pixel, step by step, in one of several formats. */
#include "base/output.h"
#include "command/command.h"
#include "command/pager.h"
#include "command/scene_override.h"
#include "reader/scene_json.h"
#include "trace/accel.h"
#include "trace/adaptive.h"
#include "walkthrough/ink.h"
#include "walkthrough/walkthrough_formats.h"

#include <stdlib.h>
#include <string.h>
#include <unistd.h>

static bool check_request(const Options *options, const Scene *scene, Error *error)
{
    const Screen *screen = &scene->screen;
    if (!options->pixel_given)
        return error_set(error, ERROR_USAGE, "trace needs --pixel COLUMN,ROW: the pixel to tell, from 0,0 to %d,%d",
                         screen->columns - 1, screen->rows - 1);
    if (options->pixel_column >= screen->columns || options->pixel_row >= screen->rows)
        return error_set(error, ERROR_USAGE, "--pixel %d,%d is outside the picture, whose pixels are 0,0 to %d,%d",
                         options->pixel_column, options->pixel_row, screen->columns - 1, screen->rows - 1);
    int grid = scene->adaptive && scene->grid > 1 ? adaptive_samples(scene->grid) : scene->grid;
    if (options->sample_i >= grid || options->sample_j >= grid)
        return error_set(error, ERROR_USAGE, "--sample %d,%d is outside the grid, whose samples are 0,0 to %d,%d",
                         options->sample_i, options->sample_j, grid - 1, grid - 1);
    return true;
}

/* --- Writing --- */

/* Lines as wide as the terminal, within bounds. */
static int columns_of(const Options *options)
{
    int columns = options->width > 0 ? options->width : terminal_size(stdout).columns;
    if (columns == 0)
        return isatty(STDOUT_FILENO) ? INK_LEAST_COLUMNS : INK_COLUMNS;
    columns = columns < INK_LEAST_COLUMNS ? INK_LEAST_COLUMNS : columns;
    return columns > INK_MOST_COLUMNS ? INK_MOST_COLUMNS : columns;
}

static WalkthroughStyle style_of(const Options *options, bool to_stdout)
{
    bool colour =
        options->colour == COLOUR_ALWAYS || (options->colour == COLOUR_AUTO && to_stdout && ink_wants_colour(stdout));
    return (WalkthroughStyle){
        .parts = options->summary ? WALKTHROUGH_SUMMARY : WALKTHROUGH_WHOLE,
        .colour = colour ? ink_terminal_colour() : INK_PLAIN,
        .columns = to_stdout ? columns_of(options) : options->width,
        .with_scene = options->with_scene,
    };
}

static bool write_paged(const Walkthrough *walk, WalkthroughStyle style, Error *error)
{
    char *text = NULL;
    size_t size = 0;
    FILE *out = open_memstream(&text, &size);
    bool written = out && walkthrough_write_text(out, walk, style, error);
    written = out && fclose(out) == 0 && written;
    if (written)
        pager_show(text);
    else if (error->kind == ERROR_NONE)
        error_memory(error, "the walkthrough");
    free(text);
    return written;
}

static bool write_file(const Options *options, const Walkthrough *walk, Error *error)
{
    WalkthroughWriter *writer = walkthrough_writer(options->format);
    const char *path = options->output;
    bool to_stdout = !path || strcmp(path, "-") == 0;
    WalkthroughStyle style = style_of(options, to_stdout);
    if (to_stdout && options->format == WALKTHROUGH_TEXT && !options->no_pager && isatty(STDOUT_FILENO))
        return write_paged(walk, style, error);
    if (to_stdout)
        return writer(stdout, walk, style, error);
    if (output_replaces(path, options->operands[0]))
        return error_set(error, ERROR_USAGE, "the walkthrough %s would replace the scene itself; choose another -o",
                         path);
    Output output;
    if (!output_open(&output, path, "the walkthrough", error))
        return false;
    if (writer(output.file, walk, style, error))
        return output_commit(&output, error);
    output_abort(&output);
    return false;
}

/* An option that the format has no use for. */
static void note_unused(const Options *options)
{
    const char *format = walkthrough_format_words[options->format];
    if (options->with_scene && options->format != WALKTHROUGH_OBJ)
        fprintf(stderr, "rectray: note: --with-scene does nothing with --format %s\n", format);
    if (options->verbose && (options->format == WALKTHROUGH_OBJ || options->format == WALKTHROUGH_SVG))
        fprintf(stderr, "rectray: note: --verbose does nothing with --format %s\n", format);
    if (options->summary && (options->format == WALKTHROUGH_OBJ || options->format == WALKTHROUGH_SVG))
        fprintf(stderr, "rectray: note: --summary does nothing with --format %s\n", format);
}

/* As the algorithm is taught every face is tested; a tree only where the user asks for one. */
static AccelKind accel_kind(const Options *options)
{
    return options->settings.accel == ACCEL_AUTO ? ACCEL_NONE : options->settings.accel;
}

static bool trace(const Options *options, const Scene *scene, Error *error)
{
    WalkthroughRequest request = {
        .column = options->pixel_column,
        .row = options->pixel_row,
        .i = options->sample_i,
        .j = options->sample_j,
        .verbose = options->verbose,
    };
    Accel accel = {.kind = ACCEL_NONE};
    Walkthrough walk = {0};
    if (!options->quiet)
        note_unused(options);
    bool done = check_request(options, scene, error) && accel_build(&accel, scene, accel_kind(options), 1, error) &&
                walkthrough_record(&walk, scene, &accel, options->operands[0], request, error) &&
                walkthrough_look_around(&walk, error) && write_file(options, &walk, error);
    walkthrough_free(&walk);
    accel_free(&accel);
    return done;
}

bool command_trace(const Options *options, Error *error)
{
    Scene scene;
    if (!scene_load(&scene, options->operands[0], error))
        return false;
    scene_override(&scene, options);
    bool done = trace(options, &scene, error);
    scene_free(&scene);
    return done;
}
