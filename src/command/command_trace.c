/* rectray trace: the walkthrough of one pixel, step by step, in one of several formats. */
#include "base/output.h"
#include "command/command.h"
#include "command/scene_override.h"
#include "reader/scene_json.h"
#include "trace/accel.h"
#include "trace/adaptive.h"
#include "walkthrough/ink.h"
#include "walkthrough/walkthrough_formats.h"

#include <string.h>

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

static bool write_file(const Options *options, const Walkthrough *walk, Error *error)
{
    WalkthroughWriter *writer = walkthrough_writer(options->format);
    WalkthroughStyle style = {.with_scene = options->with_scene};
    const char *path = options->output;
    if (!path || strcmp(path, "-") == 0) {
        style.colour = ink_wants_colour(stdout);
        return writer(stdout, walk, style, error);
    }
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

static void note_unused(const Options *options)
{
    const char *format = walkthrough_format_words[options->format];
    if (options->with_scene && options->format != WALKTHROUGH_OBJ)
        fprintf(stderr, "rectray: note: --with-scene does nothing with --format %s\n", format);
    if (options->verbose && (options->format == WALKTHROUGH_OBJ || options->format == WALKTHROUGH_SVG))
        fprintf(stderr, "rectray: note: --verbose does nothing with --format %s\n", format);
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
                write_file(options, &walk, error);
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
